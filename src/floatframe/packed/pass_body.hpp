#pragma once
// Reduced flexible bodies as bytes. Sizes and numbers of nodes, modes and points that no other
// check of `build_model` looks at are checked when they are read.
#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/body_stress.hpp"
#include "floatframe/body/flexible_body.hpp"
#include "floatframe/math/pose.hpp"
#include "floatframe/packed/byte_streams.hpp"

namespace floatframe {

/// What is wrong with the sizes and numbers of a body of unknown origin; nullptr: nothing.
const char* body_damage(const FlexibleBody& body);
/// The same of a shape that deforms with `modes` modes, of a body with `nodes` nodes.
const char* shape_damage(const BodyShape& shape, Eigen::Index modes, std::size_t nodes);

template <class S>
void pass(S& s, Pose& x) {
  auto& [p, R] = x;
  all(s, p, R);
}
template <class S>
void pass(S& s, Eigen::SparseMatrix<double, Eigen::RowMajor>& x) {
  using Sparse = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  const std::uint64_t rows = s.count(x.rows()), columns = s.whole(x.cols());
  s.require(columns <= rows, "a matrix that is not square");
  std::vector<Eigen::Triplet<double>> entries;
  if constexpr (S::reads) {
    for (std::uint64_t i = 0; i < rows; ++i) {
      const std::uint64_t n = s.count(0, 9);
      std::uint64_t column = 0;
      for (std::uint64_t k = 0; k < n; ++k) {
        column += s.whole() + (k > 0 ? 1 : 0);
        s.require(column < columns, "a matrix with a column too many");
        double value = 0.0;
        pass(s, value);
        entries.emplace_back(int(i), int(column), value);
      }
    }
    x.resize(Eigen::Index(rows), Eigen::Index(columns));
    x.setFromTriplets(entries.begin(), entries.end());
    x.makeCompressed();
  } else {
    for (int i = 0; i < x.outerSize(); ++i) {
      std::uint64_t n = 0, next = 0;
      for (Sparse::InnerIterator it(x, i); it; ++it) ++n;
      s.count(n);
      for (Sparse::InnerIterator it(x, i); it; ++it) {
        const std::uint64_t column = it.col();
        s.whole(column - next);
        next = column + 1;
        pass(s, it.valueRef());
      }
    }
  }
}
template <class S>
void pass(S& s, InertiaInvariants& v) {
  auto& [m, m_u, P_u, inner, Si, Sij] = v;
  all(s, m, m_u, P_u, inner, Si, Sij);
}
template <class S>
void pass(S& s, ModalNode& n) {
  auto& [name, p, X, X_theta] = n;
  all(s, name, p, X, X_theta);
}
template <class S>
void pass(S& s, SecondOrderNode& n) {
  auto& [node, h, theta] = n;
  all(s, node, h, theta);
}
template <class S>
void pass(S& s, SecondOrder& x) {
  auto& [S2, S2i, nodes] = x;
  all(s, S2, S2i, nodes);
}
template <class S>
void pass(S& s, ProjectionData::TurningPoint& t) {
  auto& [point, rotation, arm] = t;
  all(s, point, rotation, arm);
}
template <class S>
void pass(S& s, ProjectionData& d) {
  auto& [p, X, M_s, X_theta, M_6, h, turning, rotations, twist] = d;
  all(s, p, X, M_s, X_theta, M_6, h, turning, rotations, twist);
}
template <class S>
void pass(S& s, BodyShape::Bar& b) {
  auto& [from, to, y, round, width, height, inner] = b;
  all(s, from, to, y, round, width, height, inner);
}
template <class S>
void pass(S& s, BodyShape::Paint& p) {
  auto& [first, color] = p;
  all(s, first, color);
}
template <class S>
void pass(S& s, BodyShape& x) {
  auto& [positions, modes, triangles, lines, nodes, bars, color, paints] = x;
  all(s, positions, modes, triangles, lines, nodes, bars, color, paints);
}
template <class S>
void pass(S& s, StressGroup& g) {
  auto& [name, young, poisson] = g;
  all(s, name, young, poisson);
}
template <class S>
void pass(S& s, StressPlace& x) {
  auto& [layer, point, node, number, group, doubtful, p] = x;
  pass_word(s, layer, StressPlace::Layer::section);
  all(s, point, node, number, group, doubtful, p);
}
template <class S>
void pass(S& s, BeamSectionPlace& x) {
  auto& [element, node, number, end, p, name] = x;
  all(s, element, node, number, end, p, name);
}
template <class S>
void pass(S& s, BodyStress& x) {
  auto& [groups, places, modes, loads, sections, section_modes, section_loads, first_place] = x;
  all(s, groups, places, modes, loads, sections, section_modes, section_loads, first_place);
}
template <class S>
void pass(S& s, InterfaceDofs& x) {
  auto& [node, mask] = x;
  all(s, node, mask);
}
template <class S>
void pass(S& s, FlexibleBody& body) {
  auto& [invariants, K, D, nodes, projection, mass_model, turning, second_order, frequencies,
         equal_left_out, mode_names, shape, stress, interfaces] = body;
  all(s, invariants, K, D, nodes, projection);
  pass_word(s, mass_model, MassModel::hermite);
  all(s, turning, second_order, frequencies, equal_left_out, mode_names, shape, stress, interfaces);
  if constexpr (S::reads)
    if (const char* what = body_damage(body)) s.damaged(what);
}

}  // namespace floatframe
