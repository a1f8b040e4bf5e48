#include "floatframe/simulation/range_warnings.hpp"

#include <fmt/format.h>

namespace floatframe {

std::string warning_kind(const std::string& sentence) {
  // Words that a sentence of this kind has and none of those after it.
  for (const char* words :
       {"deforms too far for small deformations", "bends too far for small rotations",
        "spins too fast for its stiffness", "turns too far in one step", ": its sine of ",
        "passes over values in the table of", "the numerical damping of the integrator",
        "the energy balance does not close", "is too long for"})
    if (sentence.find(words) != std::string::npos) return words;
  return sentence;
}

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
