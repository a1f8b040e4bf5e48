#pragma once
// Common data of all written meshes: numbers of nodes and elements, and portable names.
#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/fe/fe_model.hpp"

namespace floatframe {

/// The numbers of the user's file, where they are positive and different; else 1, 2, 3, ...
struct WrittenNumbers {
  std::vector<int> node, element;
  int last_node = 0, last_element = 0;
};
WrittenNumbers written_numbers(const FeModel& model, std::vector<std::string>& notes);

/// Equivalent of an element in other programs.
struct WrittenCell {
  int dimension = 0, nodes = 0;
  std::uint8_t vtk = 0;
  int gmsh = 0;
};
const WrittenCell& written_cell(FeElementType type);

/// Letters, digits, '_' and '-', at most 60; in upper case on request; unique among `used`, where
/// it is added.
std::string written_name(const std::string& name, bool upper, std::set<std::string>& used);

/// Names of sets and materials that are changed in a file, for one note.
class RenamedNames {
 public:
  /// Small and capital letters are the same.
  void add(const std::string& given, const std::string& written);
  void note(std::vector<std::string>& notes) const;

 private:
  std::set<std::pair<std::string, std::string>> pairs_;
};

/// Name of the material in the model, or "MATERIAL_1".
std::string written_material(const FeModel& model, int material);

}  // namespace floatframe
