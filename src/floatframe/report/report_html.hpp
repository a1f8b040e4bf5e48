#pragma once
// The report of a run: one self-contained page (no scripts, no external files) with a summary,
// curves of all outputs as static SVG, extreme values, energies and the facts of model and
// settings. Light and dark, screen and paper.
#include <array>
#include <string>
#include <vector>

#include "floatframe/simulation/results.hpp"

namespace floatframe {

/// A titled list of name-value lines; all text is the user's or the program's, escaped when
/// written.
struct FactTable {
  std::string title;
  std::vector<std::array<std::string, 2>> rows;
};

struct Report {
  RunResult result;
  std::vector<FactTable> facts;  ///< model, settings
  std::string software;          ///< version and build
  std::string processor;
  double spectral_radius = 1.0;  ///< of the integrator: below 1 it dissipates
};

/// A failed run gets a banner that names the reason and says that the results are partial.
std::string report_html(const Report& report);

}  // namespace floatframe
