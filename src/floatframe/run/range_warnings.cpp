#include "floatframe/run/range_warnings.hpp"

#include <fmt/format.h>

namespace floatframe {

void make_strict(RunSummary& s) {
  if (s.status != "completed" || s.warnings.empty()) return;
  s.status = "failed";
  s.strict = true;
  s.message = fmt::format("{} under --strict; the results are complete",
                          s.warnings.size() == 1
                              ? std::string("1 warning counts as an error")
                              : fmt::format("{} warnings count as errors", s.warnings.size()));
}

}  // namespace floatframe
