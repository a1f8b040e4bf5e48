#pragma once
// A comparison of two results for the terminal, for other programs, and as a page for the viewer
// (viewer/README.md).
#include <optional>
#include <string>
#include <vector>

#include "floatframe/report/page_curves.hpp"
#include "floatframe/report/results_comparison.hpp"

namespace floatframe {

struct ComparedResults {
  std::string file_a, file_b;
  ResultsComparison comparison;
  std::optional<ComparisonTolerance> tolerance;  ///< none: differences are shown, not judged
  bool overlap = false;                          ///< spans may differ
};

/// What keeps two results from agreeing, a sentence each; nothing without a tolerance.
std::vector<std::string> disagreements(const ComparedResults& results);

/// Beyond the tolerance, if there is one.
bool beyond(const ComparedResults& results, const ChannelDifference& difference);
/// Largest difference for its size first. Channels that are rounding beside others of their unit
/// would lead all others.
std::vector<const ChannelDifference*> worst_first(const ResultsComparison& comparison);
/// "2 of 31 channels at 801 instants beyond 1e-06 of the size"
std::string comparison_verdict(const ComparedResults& results);
/// What is not a difference but must be known to read the figures.
std::vector<std::string> comparison_notes(const ComparedResults& results);

std::string comparison_text(const ComparedResults& results);
std::string comparison_json(const ComparedResults& results);
/// The curves of both over each other, a plot for each channel that was compared, the largest
/// difference for its size first. `a` and `b`: curves of the two files. Needs a template of the
/// viewer.
std::string comparison_page(const ComparedResults& results, const PageCurves& a,
                            const PageCurves& b, const std::string& software);

}  // namespace floatframe
