#pragma once
// Content of the page of a run, in addition to its curves and its scene.
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/page/page_curves.hpp"
#include "floatframe/page/page_tables.hpp"
#include "floatframe/run/results.hpp"

namespace floatframe {

/// A titled list of name-value lines; text is unescaped and may come from the user; it is escaped
/// when written.
struct FactTable {
  std::string title;
  std::vector<std::array<std::string, 2>> rows;
};

struct Report {
  RunResult result;
  std::vector<ChannelSubject>
      subjects;                    ///< of the columns but the time, for the grouping of curves
  std::optional<double> rows_end;  ///< end of the rows if writing failed [s]
  std::vector<FactTable> facts;    ///< model, settings
  std::vector<PageTable> tables;   ///< of the model, for the page of the viewer
  std::string software;            ///< version and build
  std::string processor;
};

}  // namespace floatframe
