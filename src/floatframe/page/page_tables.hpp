#pragma once
// Tables of the components of a model, for pages: bodies, modes with their frequencies, coordinates
// of both formulations, cut joints of the relative one.
#include <string>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/run/results.hpp"
#include "floatframe/start/check.hpp"

namespace floatframe {

struct PageTable {
  std::string heading;
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::string note{};  ///< may be empty
};

/// Name of the body of a marker; the ground if it has none.
std::string body_name(const Model& model, int marker);

/// Bodies, and modes if there are any.
std::vector<PageTable> body_tables(const Model& model);
/// Bending stiffness of bars: E I along both axes of their sections, with their directions in
/// space. No rows: no body has bars in bending.
PageTable bending_table(const Model& model);
/// Coordinates, and cut joints if there are any.
std::vector<PageTable> coordinate_tables(const Model& model, const ModelCounts& counts);

}  // namespace floatframe
