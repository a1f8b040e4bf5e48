#pragma once
// A comparison of two results as a page for the viewer (viewer/README.md).
#include <string>

#include "floatframe/report/comparison_report.hpp"
#include "floatframe/report/page_curves.hpp"

namespace floatframe {

/// The curves of both over each other, a plot for each channel that was compared, the largest
/// difference for its size first. `a` and `b`: curves of the two files. Needs a template of the
/// viewer.
std::string comparison_page(const ComparedResults& results, const PageCurves& a,
                            const PageCurves& b, const std::string& software);

}  // namespace floatframe
