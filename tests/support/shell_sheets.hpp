#pragma once
// Mapped squares of shells, and their static displacements.
#include <Eigen/SparseCholesky>
#include <vector>

#include "support/fe_models.hpp"

namespace floatframe::test {

struct Held {
  int node;
  unsigned mask;
};

/// Static displacements, six rows per node.
inline VecX solve(const FeModel& model, const std::vector<Held>& held, const VecX& f) {
  const FeSystem system = assemble(model);
  SparseMatrix K = system.K;
  const double large = 1e6 * K.coeffs().cwiseAbs().maxCoeff();
  std::vector<char> fixed(system.size(), 0);
  for (const Held& h : held) {
    for (int axis = 0; axis < 6; ++axis) {
      if ((h.mask >> axis) & 1u) fixed[system.row(h.node, axis)] = 1;
    }
  }
  for (int j = 0; j < K.outerSize(); ++j) {
    for (SparseMatrix::InnerIterator it(K, j); it; ++it) {
      const bool out = fixed[it.row()] != 0 || fixed[j] != 0;
      if (out) it.valueRef() = it.row() == j ? large : 0.0;
    }
  }
  VecX load = f;
  for (int i = 0; i < load.size(); ++i) {
    if (fixed[i] != 0) load(i) = 0.0;
  }
  return Eigen::SimplicialLDLT<SparseMatrix>(K).solve(load);
}

/// n x m cells of a mapped square, as quad4 or as pairs of tri3. Node i + (n + 1) j.
template <class Map>
FeModel sheet(FeElementType type, int n, int m, const Map& map, const Material& material,
              double thickness) {
  FeModel model;
  model.materials = {material};
  model.shells = {{thickness}};
  for (int j = 0; j <= m; ++j) {
    for (int i = 0; i <= n; ++i) {
      model.positions.push_back(map(static_cast<double>(i) / n, static_cast<double>(j) / m));
    }
  }
  for (int j = 0; j < m; ++j) {
    for (int i = 0; i < n; ++i) {
      const int a = i + (n + 1) * j, b = a + 1, d = a + n + 1, c = d + 1;
      if (type == FeElementType::quad4) {
        add_element(model, type, {a, b, c, d});
      } else {
        add_element(model, type, {a, b, c});
        add_element(model, type, {a, c, d});
      }
    }
  }
  return model;
}

}  // namespace floatframe::test
