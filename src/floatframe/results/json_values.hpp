#pragma once
// JSON helpers shared by several results (RFC 8259). SI units; the unit is in the key where it is
// not obvious. A number that is not finite becomes null.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "floatframe/loops/start_report.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// A document, with a line break at its end. Bytes that are not valid UTF-8 (text from files) are
/// replaced and cause no error.
std::string json_document(const nlohmann::ordered_json& value);

/// [x, y, z]; for a matrix its rows.
nlohmann::ordered_json json_array(const VecX& v);
nlohmann::ordered_json json_rows(const MatX& m);

nlohmann::ordered_json start_json(const StartReport& start);
nlohmann::ordered_json redundancy_json(const std::vector<RedundantDirection>& redundant);

}  // namespace floatframe
