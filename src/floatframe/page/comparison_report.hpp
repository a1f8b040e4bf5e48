#pragma once
// A comparison of two results for the terminal, for other programs, and as a page for the viewer
// (viewer/README.md).
#include <optional>
#include <string>
#include <vector>

#include "floatframe/page/page_curves.hpp"
#include "floatframe/results/results_comparison.hpp"

namespace floatframe {

struct ComparedResults {
  std::string file_a, file_b;
  ResultsComparison comparison;
  std::optional<ComparisonTolerance> tolerance;  ///< none: differences are shown without a verdict
  bool overlap = false;                          ///< spans may differ
};

/// The reasons why two results disagree, one sentence each; none without a tolerance.
std::vector<std::string> disagreements(const ComparedResults& results);

/// True if the difference exceeds the tolerance; false without one.
bool beyond(const ComparedResults& results, const ChannelDifference& difference);
/// Largest relative difference first, except channels that are rounding noise compared with others
/// of the same unit, which would come first otherwise.
std::vector<const ChannelDifference*> worst_first(const ResultsComparison& comparison);
/// "2 of 31 channels at 801 instants beyond 1e-06 of the size"
std::string comparison_verdict(const ComparedResults& results);
/// Remarks needed to interpret the figures, apart from differences.
std::vector<std::string> comparison_notes(const ComparedResults& results);

std::string comparison_text(const ComparedResults& results);
std::string comparison_json(const ComparedResults& results);
/// A page with one plot per compared channel, both curves superimposed, the largest relative
/// difference first. `a` and `b`: curves of the two files. Requires the viewer template.
std::string comparison_page(const ComparedResults& results, const PageCurves& a,
                            const PageCurves& b, const std::string& software);

}  // namespace floatframe
