#pragma once
// The report of a run: one self-contained page (no scripts, no external files) with a summary,
// curves of all outputs as static SVG, extreme values, energies and the facts of model and
// settings. Light and dark, screen and paper.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/report/page_curves.hpp"
#include "floatframe/report/page_tables.hpp"
#include "floatframe/report/report_curves.hpp"
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
  /// Of results that are in a file; else they are made of the table.
  std::optional<ReportCurves> curves;
  std::vector<ChannelSubject>
      subjects;                    ///< of the columns but the time, for the grouping of curves
  std::optional<double> rows_end;  ///< where rows that could not be written are missing [s]
  std::vector<FactTable> facts;    ///< model, settings
  std::vector<PageTable> tables;   ///< of the model, for the page of the viewer
  std::string software;            ///< version and build
  std::string processor;
  double spectral_radius = 1.0;  ///< of the integrator: below 1 it dissipates
};

/// A run that failed or was interrupted gets a banner that names the reason and says that the
/// results are partial.
std::string report_html(const Report& report);

}  // namespace floatframe
