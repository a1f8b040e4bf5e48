// Pyramids in a mesh: six round the middle of each brick.
#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/fe_system.hpp"
#include "support/fe_parts.hpp"
#include "support/quadratic_mesh.hpp"
#include "support/random_body.hpp"

namespace floatframe::test {
namespace {

/// Six pyramids a brick.
FeModel pyramids_of(const FeModel& bricks, bool middles) {
  FeModel model;
  model.materials = bricks.materials;
  model.positions = bricks.positions;
  std::map<std::pair<int, int>, int> middle;
  const auto between = [&](int a, int b) {
    const auto [it, fresh] = middle.try_emplace(std::minmax(a, b), model.nodes());
    if (fresh) model.positions.push_back(0.5 * (model.positions[a] + model.positions[b]));
    return it->second;
  };
  for (const FeElement& brick : bricks.elements) {
    Vec3 centre = Vec3::Zero();
    for (int a = 0; a < 8; ++a) centre += bricks.positions[brick.nodes[a]] / 8;
    const int apex = model.nodes();
    model.positions.push_back(centre);
    for (const FaceNodes& face : element_kernel(FeElementType::hex8).shape.faces) {
      FeElement e;
      e.type = middles ? FeElementType::pyramid13 : FeElementType::pyramid5;
      // Faces run anticlockwise seen from outside, the base seen from the apex.
      for (int i = 0; i < 4; ++i) e.nodes[i] = brick.nodes[face.nodes[3 - i]];
      e.nodes[4] = apex;
      for (int i = 0; i < 4 && middles; ++i) {
        e.nodes[5 + i] = between(e.nodes[i], e.nodes[(i + 1) % 4]);
        e.nodes[9 + i] = between(e.nodes[i], apex);
      }
      model.elements.push_back(e);
    }
  }
  validate(model);
  return model;
}

// Nodes inside of an irregular patch of both are in equilibrium in a linear field.
TEST(Pyramids, PatchTest) {
  Random random(9);
  FeModel bricks = brick_beam(2, 2, 2, 1.0, 1.0);
  for (Vec3& p : bricks.positions) p += random.vec3(0.05);
  for (const bool middles : {false, true}) {
    const FeModel model = pyramids_of(bricks, middles);
    const FeSystem system = assemble(model);
    const Mat3 G = random.matrix(3, 3);
    VecX u(3 * model.nodes());
    for (int k = 0; k < model.nodes(); ++k) u.segment<3>(3 * k) = G * model.positions[k];
    const VecX f = system.K * u;
    std::set<int> outside;
    std::map<std::vector<int>, int> faces;
    for (const FeElement& e : model.elements)
      for (const FaceNodes& face : element_kernel(e.type).shape.faces) {
        std::vector<int> key;
        for (int i = 0; i < face.corners; ++i) key.push_back(e.nodes[face.nodes[i]]);
        std::sort(key.begin(), key.end());
        ++faces[key];
      }
    for (const FeElement& e : model.elements)
      for (const FaceNodes& face : element_kernel(e.type).shape.faces) {
        std::vector<int> key;
        for (int i = 0; i < face.corners; ++i) key.push_back(e.nodes[face.nodes[i]]);
        std::sort(key.begin(), key.end());
        if (faces[key] == 1)
          for (int i = 0; i < face.count; ++i) outside.insert(e.nodes[face.nodes[i]]);
      }
    int inside = 0;
    for (int k = 0; k < model.nodes(); ++k) {
      if (outside.contains(k)) continue;
      ++inside;
      EXPECT_LT(f.segment<3>(3 * k).norm(), 1e-12 * f.norm()) << k;
    }
    EXPECT_GE(inside, middles ? 70 : 9);
  }
}

/// Mean deflection of the tip of a cantilever along x under a unit load.
double tip_of(const FeModel& model, double L) {
  const FeSystem system = assemble(model);
  std::vector<int> rows;
  for (int i = 0; i < system.size(); ++i)
    if (model.positions[system.dofs[i].node].x() > 1e-9) rows.push_back(i);
  std::vector<int> place(system.size(), -1);
  for (std::size_t i = 0; i < rows.size(); ++i) place[rows[i]] = static_cast<int>(i);
  std::vector<Eigen::Triplet<double>> entries;
  for (int j = 0; j < system.K.outerSize(); ++j)
    for (SparseMatrix::InnerIterator it(system.K, j); it; ++it)
      if (place[j] >= 0 && place[it.row()] >= 0)
        entries.emplace_back(place[it.row()], place[j], it.value());
  const auto n = static_cast<Eigen::Index>(rows.size());
  SparseMatrix K(n, n);
  K.setFromTriplets(entries.begin(), entries.end());
  VecX f = VecX::Zero(n);
  std::vector<int> tip;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Dof& d = system.dofs[rows[i]];
    if (d.axis == 2 && model.positions[d.node].x() > L - 1e-9) tip.push_back(static_cast<int>(i));
  }
  for (const int i : tip) f(i) = 1.0 / static_cast<double>(tip.size());
  const VecX u = Eigen::SimplicialLDLT<SparseMatrix>(K).solve(f);
  double mean = 0.0;
  for (const int i : tip) mean += u(i) / static_cast<double>(tip.size());
  return mean;
}

// A slender cantilever bends as one of bricks with 20 nodes does, and both nearly as a beam.
TEST(Pyramids, Cantilever) {
  const double L = 1.0, b = 0.1;
  const FeModel bricks = brick_beam(10, 1, 1, L, b);
  const Material& m = bricks.materials[0];
  const double I = b * b * b * b / 12;
  const double beam = L * L * L / (3 * m.young * I) + 1.2 * L / (m.shear() * b * b);
  const double pyramids = tip_of(pyramids_of(bricks, true), L);
  const double hex20 = tip_of(hex20_of(bricks), L);
  RecordProperty("deflections",
                 std::to_string(pyramids / beam) + " " + std::to_string(hex20 / beam));
  EXPECT_NEAR(hex20 / beam, 1.0, 0.025);
  EXPECT_NEAR(pyramids / beam, 1.0, 0.025);
  EXPECT_NEAR(pyramids / hex20, 1.0, 0.005);
}

}  // namespace
}  // namespace floatframe::test
