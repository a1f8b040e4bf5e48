#include "floatframe/tangents/mass_scale.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/formulation/composite_diagonal.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {

namespace {

void fill_gaps(VecX& masses, const Model& model) {
  for (double& m : masses)
    if (!(m > 0.0)) m = model.mean_mass;
}

}  // namespace

double possible_mass(const Model& model, std::size_t body) {
  const double m = model.bodies[body].data->invariants.m;
  return m > 0.0 ? m : model.mean_mass;
}

double possible_modal_mass(const Model& model, std::size_t body, int mode, double reach2) {
  const FlexibleBody& data = *model.bodies[body].data;
  double most = 0.0;
  for (const ModalNode& n : data.nodes)
    most = std::max(most, n.X.col(mode).squaredNorm() + reach2 * n.X_theta.col(mode).squaredNorm());
  double own = 0.0;
  for (std::size_t i = 0; i < 3; ++i) own += std::abs(data.invariants.Sij[i][i](mode, mode));
  return std::max(own, possible_mass(model, body) * most);
}

namespace {

VecX possible_in_tree(RelativeFormulation& f, const State& state) {
  const Model& model = f.model();
  const TreeKinematics& tree = f.tree();
  f.positions(state.t, state.q);
  // Wrenches are about one common point, and their round-off grows with the distance from it.
  std::vector<MatX> possible;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Vec3& p_OB = tree.body(static_cast<int>(i)).p_OB;
    const double m = possible_mass(model, i), l = model.bodies[i].length;
    const double reach2 = l * l + p_OB.squaredNorm();
    const int modes = model.bodies[i].modes();
    MatX M = MatX::Zero(6 + modes, 6 + modes);
    const Mat3 p = skew(p_OB);  // the frame of a body moves by sdot - p x omega
    M.topLeftCorner<3, 3>() = m * Mat3::Identity();
    M.block<3, 3>(0, 3) = -m * p;
    M.block<3, 3>(3, 0) = m * p;
    M.block<3, 3>(3, 3) = m * (reach2 * Mat3::Identity() - p * p);
    for (int k = 0; k < modes; ++k) M(6 + k, 6 + k) = possible_modal_mass(model, i, k, reach2);
    possible.push_back(std::move(M));
  }
  VecX masses = composite_diagonal(
      tree, [&](int i) -> const MatX& { return possible[static_cast<std::size_t>(i)]; });
  fill_gaps(masses, model);
  return masses;
}

VecX possible_in_axes(const Formulation& f) {
  const Model& model = f.model();
  VecX masses = VecX::Zero(f.velocities());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const double m = possible_mass(model, i), l = model.bodies[i].length;
    const int modes = model.bodies[i].modes();
    const BodyCoordinates c = f.body_coordinates(static_cast<int>(i));
    const int at = c.v, size = c.v_count;
    // Frame origin, axes, modes, points on the body.
    masses.segment(at, size).setConstant(m);
    masses.segment(at + 3, 9).setConstant(m * l * l);
    for (int k = 0; k < modes; ++k) masses[at + 12 + k] = possible_modal_mass(model, i, k, l * l);
  }
  fill_gaps(masses, model);
  return masses;
}

}  // namespace

VecX possible_masses(Formulation& f, const State& state) {
  auto* relative = dynamic_cast<RelativeFormulation*>(&f);
  return relative != nullptr ? possible_in_tree(*relative, state) : possible_in_axes(f);
}

VecX mass_scale(const VecX& diagonal, const VecX& possible) {
  return diagonal.cwiseAbs().cwiseMax(1e-4 * possible);
}

VecX test_accelerations(const VecX& r0, const VecX& possible) {
  const VecX roots = possible.cwiseSqrt();
  const double size = r0.size() > 0 ? r0.cwiseAbs().cwiseQuotient(roots).maxCoeff() : 1.0;
  return std::max(1.0, size) * roots.cwiseInverse();
}

}  // namespace floatframe
