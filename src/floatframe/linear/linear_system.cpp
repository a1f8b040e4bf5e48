#include "floatframe/linear/linear_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/formulation/owners.hpp"
#include "floatframe/linear/linear_reduction.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/sampling.hpp"
#include "floatframe/run/body_energy.hpp"
#include "floatframe/start/start_up.hpp"
#include "floatframe/stepping/samples.hpp"
#include "floatframe/stepping/simulation_options.hpp"

namespace floatframe {

namespace {

/// Of an element, in `springs_of`.
constexpr int spring_rows = Efforts::most_rows;

/// Components of the motions of each state at bodies and force elements.
void describe_motions(Formulation& f, const State& state, LinearSystem& system) {
  const Model& model = f.model();
  Eigen::Index rates = 0, bends = 0;
  for (const Body& b : model.bodies) rates += 6 + b.modes(), bends += b.modes();
  const Eigen::Index nz = system.A.rows(),
                     forces = static_cast<Eigen::Index>(model.elements.size());
  system.rates_of = MatX::Zero(rates, nz);
  system.bends_of = MatX::Zero(bends, nz);
  system.springs_of = MatX::Zero(spring_rows * forces, nz);
  system.places_of = MatX::Zero(6 * static_cast<Eigen::Index>(model.bodies.size()), nz);
  // The stiffness of forces at the present state; their measures in the motions, below.
  dynamics_at(f, state);
  for (const BodyKinematics& b : f.motion().bodies) system.amplitudes.push_back(b.y);
  std::vector<Efforts> found;
  for (Eigen::Index k = 0; k < forces; ++k) found.push_back(f.effort(static_cast<int>(k)));
  for (Eigen::Index z = 0; z < nz; ++z) {
    f.velocities(VecX(system.v_of.col(z)));
    Eigen::Index row = 0, bend = 0;
    for (const BodyKinematics& b : f.motion().bodies) {
      const Mat3 to_body = b.R_WB.transpose();
      system.rates_of.block<3, 1>(row, z) = to_body * b.v_WB;
      system.rates_of.block<3, 1>(row + 3, z) = to_body * b.w_WB;
      system.rates_of.block(row + 6, z, b.yd.size(), 1) = b.yd;
      row += 6 + b.yd.size();
    }
    // Increments move markers in the same way as velocities.
    const VecX x = system.x_of.col(z);
    f.velocities(x);
    row = 0;
    for (const BodyKinematics& b : f.motion().bodies) {
      system.places_of.block<3, 1>(row, z) = b.v_WB;
      system.places_of.block<3, 1>(row + 3, z) = b.w_WB;
      system.bends_of.block(bend, z, b.yd.size(), 1) = b.yd;
      row += 6;
      bend += b.yd.size();
    }
    for (Eigen::Index k = 0; k < forces; ++k) {
      const std::vector<int>& markers = model.elements[static_cast<std::size_t>(k)].markers;
      const Efforts& s = found[static_cast<std::size_t>(k)];
      for (int r = 0; r < s.row_count; ++r) {
        if (!(s.rows[r].k > 0.0)) continue;
        double moved = 0.0;
        for (std::size_t i = 0; i < markers.size(); ++i) {
          const Wrench& g = s.gradient(r)[i];
          moved += g.F.dot(f.marker(markers[i]).v) + g.T.dot(f.marker(markers[i]).w);
        }
        system.springs_of(spring_rows * k + r, z) = std::sqrt(s.rows[r].k) * moved;
      }
    }
  }
  dynamics_at(f, state);
}

}  // namespace

LinearSystem linear_system_at(Formulation& f, const State& state, const InputMotions* inputs,
                              LinearInputs* response, int slowest) {
  const double speed = largest(state.v);
  const bool relative = f.coordinates() == Coordinates::relative;
  if (!relative && speed > 1e-6)
    throw RunError(ErrorCode::unsupported,
                   "the state moves: its linear system needs relative coordinates, since those of "
                   "the absolute formulation turn with the bodies");
  const SmallMotions m = small_motions(f, state);
  LinearSystem system = reduced_system(m, unknown_owners(f), inputs, response, slowest);
  system.elements_of = system.x_of.bottomRows(m.states);
  for (MatX* of : {&system.x_of, &system.v_of, &system.a_of, &system.xdot_of})
    of->conservativeResize(f.velocities(), Eigen::NoChange);
  if (!inputs) describe_motions(f, state, system);
  system.speed = speed;
  system.acceleration = largest(state.a);
  if (system.acceleration > 1e-3)
    system.notes.push_back(
        fmt::format("the state is no {}: coordinates accelerate by up to {:.3g} [m/s2, rad/s2]; "
                    "the linear system holds for a short time only",
                    speed > 1e-6 ? "steady motion" : "equilibrium", system.acceleration));
  if (std::string held = held_samples_note(f.model()); !held.empty())
    system.notes.push_back(std::move(held));
  std::vector<std::string> owners;
  for (const int k : m.kinks) {
    std::string owner = f.coordinate_owner(k);
    if (std::find(owners.begin(), owners.end(), owner) != owners.end()) continue;
    system.notes.push_back(fmt::format(
        "along {} a force has no one slope here: a mean of both sides was taken", owner));
    owners.push_back(std::move(owner));
  }
  return system;
}

double LinearMode::frequency() const noexcept {
  return std::abs(lambda) / (2.0 * std::numbers::pi);
}
double LinearMode::damped() const noexcept {
  return std::abs(lambda.imag()) / (2.0 * std::numbers::pi);
}
double LinearMode::damping() const noexcept {
  const double size = std::abs(lambda);
  return size > 0.0 ? -lambda.real() / size : 0.0;
}

CountedStiffening counted_at(const Model& model, const SimulationOptions& options) {
  Model there = built(model);
  there.simulation = described(model, options);
  CountedStiffening counted = counted_stiffening(there);
  counted.model.linear = true;
  for (const Element& e : counted.model.elements)
    if (const auto note = element_kind(e.type).linear_note)
      if (std::string text = note(e); !text.empty()) counted.notes.push_back(std::move(text));
  return counted;
}

void say_counted(const CountedStiffening& counted, LinearSystem& system) {
  system.stiffened = counted.bodies;
  system.stiffening = counted.sentence;
  system.notes.insert(system.notes.begin(), counted.notes.begin(), counted.notes.end());
}

std::vector<LinearMode> linear_modes(const LinearSystem& system) {
  const GeneralEigen e = general_eigen(system.A);
  if (!e.found)
    throw RunError(ErrorCode::no_convergence,
                   "the eigenvalues of the linear system do not converge");
  std::vector<LinearMode> modes;
  for (Eigen::Index k = 0; k < e.values.size(); ++k)
    if (e.values[k].imag() >= 0.0) modes.push_back({e.values[k], e.vectors.col(k)});
  std::stable_sort(modes.begin(), modes.end(), [](const LinearMode& a, const LinearMode& b) {
    return std::abs(a.lambda) < std::abs(b.lambda);
  });
  return modes;
}

ModeParts mode_parts(const Model& model, const LinearSystem& system, const LinearMode& mode) {
  ModeParts parts;
  const VecX z[2] = {mode.z.real(), mode.z.imag()};
  const std::size_t bodies = model.bodies.size(), forces = model.elements.size();
  parts.kinetic.assign(bodies, 0.0);
  parts.bending.assign(bodies, 0.0);
  parts.springs.assign(forces, 0.0);
  std::vector<BodyEnergy> energies;
  for (const Body& b : model.bodies)
    energies.emplace_back(b.data->invariants, second_order_on_masses(*b.data, b.stiffens()).get());
  for (const VecX& part : z) {
    const VecX rates = system.rates_of * part, bends = system.bends_of * part,
               springs = system.springs_of * part;
    Eigen::Index row = 0, bend = 0;
    for (std::size_t i = 0; i < bodies; ++i) {
      const Body& b = model.bodies[i];
      const int nm = b.modes();
      parts.kinetic[i] += energies[i].kinetic(rates.segment<3>(row), rates.segment<3>(row + 3),
                                              system.amplitudes[i].data(), rates.data() + row + 6);
      const VecX y = bends.segment(bend, nm);
      if (nm > 0) parts.bending[i] += 0.5 * y.dot(b.data->K * y);
      row += 6 + nm;
      bend += nm;
    }
    for (std::size_t k = 0; k < forces; ++k)
      parts.springs[k] +=
          0.5 *
          springs.segment<spring_rows>(spring_rows * static_cast<Eigen::Index>(k)).squaredNorm();
  }
  double kinetic = 0.0, potential = 0.0;
  for (const double t : parts.kinetic) kinetic += t;
  for (const double u : parts.bending) potential += u;
  for (const double u : parts.springs) potential += u;
  for (double& t : parts.kinetic) t = kinetic > 0.0 ? t / kinetic : 0.0;
  for (double& u : parts.bending) u = potential > 0.0 ? u / potential : 0.0;
  for (double& u : parts.springs) u = potential > 0.0 ? u / potential : 0.0;
  parts.potential = kinetic > 0.0 ? potential / kinetic : 0.0;
  return parts;
}

LinearSystem linear_system(const Model& model, const SimulationOptions& options, int slowest) {
  const CountedStiffening counted = counted_at(model, options);
  const SimulationDescription& d = counted.model.simulation;
  InitialisedModel started(counted.model, d);
  const std::string unsettled = settle_samples(started, d.step);
  LinearSystem system =
      linear_system_at(started.formulation(), started.state(), nullptr, nullptr, slowest);
  say_counted(counted, system);
  if (!unsettled.empty()) system.notes.push_back(unsettled);
  return system;
}

}  // namespace floatframe
