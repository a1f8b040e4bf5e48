#pragma once
// Finite-element parts of tests/data/fe in SI units, and small ones made here.
#include <filesystem>
#include <string>
#include <vector>

#include "floatframe/fe/unit_system.hpp"
#include "floatframe/formats/fe_file.hpp"
#include "floatframe/reduction/part.hpp"
#include "support/fe_models.hpp"

namespace floatframe::test {

inline std::filesystem::path fe_data(const std::string& name) {
  return std::filesystem::path(FLOATFRAME_TEST_DATA) / "fe" / name;
}

inline constexpr Material steel{.young = 2.1e11, .poisson = 0.3, .density = 7850.0};

/// A mesh without a material, in the named units, made of steel.
inline FeModel steel_part(const std::string& file, const std::string& units) {
  FeModel model = read_fe_file(fe_data(file));
  to_si(model, *find_unit_system(units));
  model.materials = {steel};
  for (FeElement& e : model.elements) e.material = 0;
  return model;
}

inline InterfaceDescription bore(const std::string& set, std::optional<Vec3> at = {}) {
  InterfaceDescription d;
  d.name = set;
  d.choice.set = set;
  d.at = at;
  return d;
}

inline NodeChoice nearest_to(const Vec3& point) {
  NodeChoice choice;
  choice.by = NodeChoice::By::nearest;
  choice.point = point;
  return choice;
}

/// By its number in the file.
inline NodeChoice node_number(int number) {
  NodeChoice choice;
  choice.by = NodeChoice::By::node;
  choice.number = number;
  return choice;
}

/// Its reference point is in the middle of the nodes.
inline InterfaceDescription interface_at(const std::string& name, const NodeChoice& choice,
                                         unsigned mask = 63u) {
  InterfaceDescription d;
  d.name = name;
  d.choice = choice;
  d.mask = mask;
  return d;
}

/// Bores of the A-arm and of the connecting rod; reference points as in the data's spiders.
inline std::vector<InterfaceDescription> arm_bores() {
  return {bore("BUSH_F", Vec3(0.15, 0, 0)), bore("BUSH_R", Vec3(-0.15, 0, 0)),
          bore("BALL", Vec3(-0.02, 0.33, 0.007)), bore("DAMP_F", Vec3(0.02, 0.16, 0.045)),
          bore("DAMP_R", Vec3(-0.02, 0.16, 0.045))};
}

/// A beam of nx x ny x nz bricks with the sets A (x = 0) and B (x = length).
inline FeModel brick_beam(int nx, int ny, int nz, double length, double width) {
  FeModel model;
  model.materials = {steel};
  const auto at = [&](int i, int j, int k) { return (i * (ny + 1) + j) * (nz + 1) + k; };
  for (int i = 0; i <= nx; ++i)
    for (int j = 0; j <= ny; ++j)
      for (int k = 0; k <= nz; ++k) {
        model.positions.emplace_back(length * i / nx, width * j / ny, width * k / nz);
        if (i == 0) model.node_sets["A"].push_back(at(i, j, k));
        if (i == nx) model.node_sets["B"].push_back(at(i, j, k));
        if (i == nx / 2) model.node_sets["MIDDLE"].push_back(at(i, j, k));
      }
  for (int i = 0; i < nx; ++i)
    for (int j = 0; j < ny; ++j)
      for (int k = 0; k < nz; ++k) {
        add_element(
            model, FeElementType::hex8,
            {at(i, j, k), at(i + 1, j, k), at(i + 1, j + 1, k), at(i, j + 1, k), at(i, j, k + 1),
             at(i + 1, j, k + 1), at(i + 1, j + 1, k + 1), at(i, j + 1, k + 1)});
      }
  return model;
}

}  // namespace floatframe::test
