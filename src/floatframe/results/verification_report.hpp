#pragma once
// How a run depends on its step (run/verification.hpp), for the terminal, the summary and the page.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "floatframe/run/results.hpp"

namespace floatframe {

/// "steps of 0.5 and 0.25 ms, at 2001 instants from 0 to 2 s"
std::string verification_scope(const Verification& v);
/// "largest error estimated 0.12 % of the range of tip.x, orders 1.98 to 2.02"
std::string verification_verdict(const Verification& v);

std::vector<std::string> verification_columns();
/// At most `most` rows, the largest error relative to the range first, rounding last.
std::vector<std::vector<std::string>> verification_rows(const Verification& v, std::size_t most);

std::string verification_text(const Verification& v);
nlohmann::ordered_json verification_json(const Verification& v);

}  // namespace floatframe
