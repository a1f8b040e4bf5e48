#include "floatframe/linear/linear_ports.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/formulation/owners.hpp"
#include "floatframe/linear/excited_system.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/start/system_state.hpp"
#include "floatframe/stepping/samples.hpp"
#include "floatframe/stepping/simulation_options.hpp"
#include "floatframe/tangents/mass_scale.hpp"

namespace floatframe {
namespace {

/// The named ones, in that order; all if none is named.
template <class T>
std::vector<T> chosen(const std::vector<T>& all, const std::vector<std::string>& names,
                      const char* kind) {
  if (names.empty()) return all;
  std::vector<std::string> known;
  for (const T& one : all) known.push_back(one.name);
  std::vector<T> found;
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      const std::string none = fmt::format("; the model has no {}s", kind);
      throw InputError(ErrorCode::not_found,
                       fmt::format("unknown {} '{}'{}", kind, excerpt(name),
                                   known.empty() ? none : did_you_mean(name, known)));
    }
    found.push_back(all[static_cast<std::size_t>(at - known.begin())]);
  }
  return found;
}

/// The longest step along a motion whose coordinates do not move farther than `steps`.
double step_along(const VecX& motion, const VecX& steps) {
  double h = 1e300;
  for (Eigen::Index j = 0; j < motion.size(); ++j)
    if (motion[j] != 0.0) h = std::min(h, steps[j] / std::abs(motion[j]));
  return h;
}

/// dy for unit motions with these columns of x, v and a.
VecX output_column(ExcitedSystem& excited, double h, const VecX& x, const VecX& v, const VecX& a) {
  return precise_differences(
             VecX::Constant(1, h), 0,
             [&](const VecX& s) { return excited.outputs(s[0] * x, s[0] * v, s[0] * a); })
      .columns;
}

void find_output_columns(ExcitedSystem& excited, const std::vector<double>& input_steps,
                         const LinearInputs& moved, LinearModel& linear) {
  const LinearSystem& system = linear.system;
  const Eigen::Index nz = system.A.rows(), ny = linear.output_values.size(),
                     nu = static_cast<Eigen::Index>(linear.inputs.size());
  Formulation& f = excited.formulation();
  const VecX steps = unknown_steps(f.model(), possible_masses(f, excited.state()), excited.state());
  linear.C.resize(ny, nz);
  const VecX still = VecX::Zero(excited.unknowns());
  const VecX parts = excited.outputs(still, still, still);
  for (Eigen::Index z = 0; z < nz; ++z) {
    tell_progress("outputs", 1.0 * z / nz);
    VecX x(excited.unknowns());
    x << system.x_of.col(z), system.elements_of.col(z);
    const VecX v = system.v_of.col(z);
    const double h = std::min({step_along(x, steps), step_along(v, 10.0 * steps), 1e3});
    const VecX dparts = output_column(excited, h, x, v, VecX(system.a_of.col(z)));
    linear.C.col(z) = excited.output_derivatives(parts, dparts, nullptr);
  }
  for (MatX& D : linear.D) D = MatX::Zero(ny, nu);
  for (Eigen::Index j = 0; j < nu; ++j) {
    const LinearInput& input = linear.inputs[j];
    for (int k = 0; k <= input.order(); ++k) {
      const VecX x = k == 0 ? VecX(moved.x.col(j)) : still;
      const VecX v = k < 2 ? VecX(moved.v[k].col(j)) : still;
      const double h = input_steps[j] * std::pow(10.0, k);
      const VecX a = moved.a[k].col(j);
      const VecX dparts = precise_differences(VecX::Constant(1, h), 0, [&](const VecX& s) {
                            excited.move(input, s[0] * Vec3::Unit(k));
                            return excited.outputs(s[0] * x, s[0] * v, s[0] * a);
                          }).columns;
      linear.D[k].col(j) = excited.output_derivatives(parts, dparts, k == 0 ? &input : nullptr);
    }
    excited.move(input, Vec3::Zero());
  }
}

/// The states of a system as names.
std::vector<StateName> names_of_states(const Formulation& f, const LinearSystem& system) {
  const std::vector<std::string> words = disambiguated_names(unknown_owners(f));
  const std::vector<StateName> unknowns = unknown_names(f);
  std::map<std::string, StateName> known;
  for (std::size_t k = 0; k < words.size(); ++k) {
    StateName name = unknowns[k];
    known.emplace(words[k], name);
    name.rate = true;
    known.emplace("rate of " + words[k], name);
  }
  std::vector<StateName> names;
  for (const std::string& state : system.states) {
    const auto at = known.find(state);
    names.push_back(at != known.end() ? at->second : StateName{StateKind::combination, state});
  }
  return names;
}

SystemState state_of(InitialisedModel& started, InertiaMethod inertia) {
  JointFollower joints(started.model());
  kinematics_at(started.formulation(), started.state());
  SystemState state = system_state(started.formulation().motion(), joints);
  place_bodies(started.model(), inertia, state);
  return state;
}

LinearModel linear_model_of(const Model& model, const LinearPorts& ports,
                            const SimulationDescription& options) {
  LinearModel linear;
  linear.inputs = chosen(linear_inputs(model), ports.inputs, "input");
  const std::vector<Output> outputs = chosen(model.outputs, ports.outputs, "output");
  for (const Output& output : outputs) linear.outputs.push_back({output.name, output.unit});
  InitialisedModel started(model, options);
  const std::string unsettled = settle_samples(started, options.step);
  ExcitedSystem excited(started, outputs, options.step);
  Formulation& f = excited.formulation();
  const Eigen::Index n = excited.unknowns(), nc = f.constraints(),
                     nu = static_cast<Eigen::Index>(linear.inputs.size());
  InputMotions motions;
  motions.value = MatX::Zero(nc, nu);
  for (int k = 0; k < 3; ++k) {
    motions.residual[k] = MatX::Zero(n, nu);
    motions.rate[k] = motions.acceleration[k] = MatX::Zero(nc, nu);
  }
  std::vector<double> steps;
  linear.input_values.resize(nu);
  for (Eigen::Index j = 0; j < nu; ++j) {
    const LinearInput& input = linear.inputs[j];
    steps.push_back(excited.step_of(input));
    excited.derivatives(input, steps.back(), j, motions);
    linear.input_values[j] = excited.value(input);
  }
  kinematics_at(f, excited.state());
  for (LinearInput& input : linear.inputs)
    if (input.wheels.size() == 1) {
      const Element& wheel = model.elements[input.wheels[0]];
      input.place = f.motion().place(wheel.markers[0]).x();
    }
  LinearInputs moved;
  linear.system = linear_system_at(f, excited.state(), &motions, &moved);
  linear.names = names_of_states(f, linear.system);
  linear.time = excited.state().t;
  linear.state = std::make_shared<SystemState>(state_of(started, options.inertia));
  const VecX still = VecX::Zero(n);
  linear.output_values = excited.output_values(excited.outputs(still, still, still));
  for (int k = 0; k < 3; ++k) linear.B[k] = moved.B[k];
  find_output_columns(excited, steps, moved, linear);
  if (!unsettled.empty()) linear.system.notes.push_back(unsettled);
  std::vector<std::string> open = excited.open_outputs();  // of a formula once for each part
  open.erase(std::unique(open.begin(), open.end()), open.end());
  for (const std::string& name : open)
    linear.system.notes.push_back(
        fmt::format("output {} is not unique, since constraints are redundant: of the reactions "
                    "that are possible those of least norm are given",
                    name));
  return linear;
}

}  // namespace

std::vector<LinearInput> linear_inputs(const Model& model) {
  using Kind = LinearInput::Kind;
  std::vector<LinearInput> inputs;
  for (std::size_t k = 0; k < model.inputs.size(); ++k)
    inputs.push_back(
        {model.inputs[k].name, model.inputs[k].unit, Kind::signal, static_cast<int>(k), {}, 0.0});
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    if (element_kind(e.type).list != ElementList::motions) continue;
    const CoordinatePort& of = e.coordinates[0];
    inputs.push_back({"motion of " + e.name,
                      joint_unit_name(model.joints[of.joint].type, of.component),
                      Kind::motion,
                      static_cast<int>(k),
                      {},
                      0.0});
  }
  std::vector<int> wheels;
  for (std::size_t k = 0; k < model.elements.size(); ++k)
    if (*lifted_by(model.elements[k].type)) wheels.push_back(static_cast<int>(k));
  if (!wheels.empty()) inputs.push_back({"road", "m", Kind::road, -1, wheels, 0.0});
  if (wheels.size() > 1)
    for (const int k : wheels)
      inputs.push_back({"road at " + model.elements[k].name, "m", Kind::road, -1, {k}, 0.0});
  return inputs;
}

LinearModel linear_model(const Model& model, const LinearPorts& ports,
                         const SimulationOptions& options) {
  const CountedStiffening counted = counted_at(model, options);
  const SimulationDescription& d = counted.model.simulation;
  LinearModel linear = linear_model_of(counted.model, ports, d);
  say_counted(counted, linear.system);
  return linear;
}

LinearModel linear_model(const Simulation& simulation, const LinearPorts& ports) {
  Model there = simulation.model();
  for (std::size_t k = 0; k < there.inputs.size(); ++k)
    there.inputs[k].initial = simulation.inputs()[k];
  SimulationDescription& d = there.simulation;
  d = simulation.options();
  d.coordinates = Coordinates::relative;
  d.start = Start::state;
  d.state = std::make_shared<SystemState>(simulation.state());
  d.velocity.setZero();  // included in the state
  d.offset.clear();
  return linear_model(there, ports);
}

StateSpace state_space(const LinearModel& linear) {
  StateSpace s;
  const Eigen::Index nz = linear.system.A.rows(), ny = linear.C.rows(),
                     nu = static_cast<Eigen::Index>(linear.inputs.size());
  Eigen::Index n = nz;
  for (const LinearInput& input : linear.inputs) n += input.order();
  s.A = MatX::Zero(n, n);
  s.B = MatX::Zero(n, nu);
  s.C = MatX::Zero(ny, n);
  s.D = MatX::Zero(ny, nu);
  s.A.topLeftCorner(nz, nz) = linear.system.A;
  s.C.leftCols(nz) = linear.C;
  s.states = linear.system.states;
  s.names = linear.names;
  s.outputs = linear.outputs;
  const char* const before[] = {"", "rate of ", "acceleration of "};
  const char* const per[] = {"", "/s", "/s2"};
  Eigen::Index at = nz;
  for (Eigen::Index j = 0; j < nu; ++j) {
    const LinearInput& input = linear.inputs[j];
    const int order = input.order();
    for (int k = 0; k < order; ++k, ++at) {  // u, u': states
      s.A.col(at).head(nz) = linear.B[k].col(j);
      s.C.col(at) = linear.D[k].col(j);
      if (k + 1 < order)
        s.A(at, at + 1) = 1.0;
      else
        s.B(at, j) = 1.0;
      s.states.push_back(before[k] + input.name);
      s.names.push_back({StateKind::input, input.name, k});
    }
    s.B.col(j).head(nz) = linear.B[order].col(j);
    s.D.col(j) = linear.D[order].col(j);
    s.inputs.push_back(
        {before[order] + input.name, input.unit.empty() ? "" : input.unit + per[order]});
  }
  return s;
}

}  // namespace floatframe
