#pragma once
// Are the numbers of a body file those of a body, and does it say the same where it says things
// twice: arrays, header, health report?
#include <cstdint>
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/body_file/body_file.hpp"
#include "floatframe/formats/body_file/body_members.hpp"

namespace floatframe {

/// Numbers of the header that are not part of the body.
struct BodyHeader {
  std::vector<double> frequencies;                    ///< of each mode [Hz]; -1: not given
  std::vector<std::vector<std::int64_t>> moves_with;  ///< surface points of each marker
  StressNames stress;
};

/// `content`: complete, of sizes that fit. `name`: of the file.
void check_body_numbers(const BodyFile& content, const BodyHeader& header, ArrayReader& arrays,
                        ErrorList& errors, const std::string& name);

}  // namespace floatframe
