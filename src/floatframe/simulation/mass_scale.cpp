#include "floatframe/simulation/mass_scale.hpp"

#include <algorithm>
#include <cmath>

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

VecX possible_masses(RelativeFormulation& f, const State& state) {
  const Model& model = f.model();
  const std::size_t n = model.bodies.size();
  VecX masses = VecX::Zero(f.velocities());
  f.positions(state.t, state.q);
  // Wrenches are taken about one common point, and their round-off grows with the distance from it.
  std::vector<double> reach2(n);
  std::vector<std::vector<double>> modal(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double l = model.bodies[i].length;
    reach2[i] = l * l + (f.body_position(static_cast<int>(i)) - f.origin()).squaredNorm();
    for (int k = 0; k < model.bodies[i].modes(); ++k)
      modal[i].push_back(possible_modal_mass(model, i, k, reach2[i]));
  }
  for (int j = 0; j < f.velocities(); ++j) {
    const VecX v = VecX::Unit(f.velocities(), j);
    f.velocities(v);
    for (std::size_t i = 0; i < n; ++i) {
      const int body = static_cast<int>(i);
      masses[j] +=
          possible_mass(model, i) * (f.body_velocity(body).squaredNorm() +
                                     reach2[i] * f.body_angular_velocity(body).squaredNorm());
      for (std::size_t k = 0; k < modal[i].size(); ++k)
        if (f.amplitude_rate(v, body, static_cast<int>(k)) != 0.0) masses[j] += modal[i][k];
    }
  }
  fill_gaps(masses, model);
  return masses;
}

VecX possible_masses(AbsoluteFormulation& f, const State&) {
  const Model& model = f.model();
  VecX masses = VecX::Zero(f.velocities());
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const double m = possible_mass(model, i), l = model.bodies[i].length;
    const int modes = model.bodies[i].modes(), size = f.body_size(static_cast<int>(i));
    // Frame origin, axes, modes, points on the body.
    masses.segment(at, size).setConstant(m);
    masses.segment(at + 3, 9).setConstant(m * l * l);
    for (int k = 0; k < modes; ++k) masses[at + 12 + k] = possible_modal_mass(model, i, k, l * l);
    at += size;
  }
  fill_gaps(masses, model);
  return masses;
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
