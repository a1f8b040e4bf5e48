#include "floatframe/tangents/overflow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/local_formula.hpp"

namespace floatframe {

/// Begins what is no overflow but a formula without a value.
constexpr std::string_view undefined_mark = "a formula has no value: ";

std::string overflow_text(Formulation& f, const State& state, double t, double limit) {
  const Model& model = f.model();
  std::string text;
  const auto look = [&](double x, const auto& sentence) {
    if (text.empty() && !(std::abs(x) < limit))
      text = sentence(std::isnan(x)   ? "not a number"
                      : std::isinf(x) ? "more than 1e+308"
                                      : fmt::format("{:.3g}", std::abs(x)));
  };
  for (const Joint& j : model.joints)
    for (int k = 0; k < joint_velocities(j.type); ++k) {
      const TimeFunction* law = model.motion_of(j, k);
      if (!law) continue;
      const auto motion = evaluate(*law, t);
      if (std::string why = law->formula ? fault_at(*law->formula, t) : ""; !why.empty())
        return fmt::format("{}joint '{}': {}", undefined_mark, j.name, why);
      for (const double x : {motion.f, motion.df, motion.ddf})
        look(x, [&](const std::string& n) {
          return fmt::format("the motion of joint '{}' or its rate reaches {} [m, rad, s]", j.name,
                             n);
        });
    }
  kinematics_at(f, t, state.q, state.v);
  f.forces();
  const SystemMotion& motion = f.motion();
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    look(motion.bodies[i].w_WB.stableNorm(), [&](const std::string& n) {
      return fmt::format("body '{}' turns at {} rad/s", model.bodies[i].name, n);
    });
    look(motion.bodies[i].v_WB.stableNorm(), [&](const std::string& n) {
      return fmt::format("body '{}' moves at {} m/s", model.bodies[i].name, n);
    });
  }
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& force = model.elements[k];
    const Efforts& now = motion.efforts[k];
    const auto slope = [&](const char* law, const char* unit) {
      return [&force, law, unit](const std::string& n) {
        return fmt::format("the {} of '{}' has a slope of {} [{}]", law, force.name, n, unit);
      };
    };
    if (force.laws.size() == 2) {  // of its measure
      look(force.laws[0](now.length).df, slope("spring", "N/m, N m/rad"));
      look(force.laws[1](now.rate).df, slope("damper", "N s/m, N m s/rad"));
    }
    if (std::string why = std::isnan(now.force) ? undefined_formula_text(f) : ""; !why.empty())
      return std::string(undefined_mark) + why;
    look(now.force, [&](const std::string& n) {
      return force.exerts() ? fmt::format("the force of '{}' is {} [N, N m]", force.name, n)
                            : fmt::format("the value of {} is {}", element_name(force), n);
    });
  }
  return text;
}

std::string undefined_formula_text(Formulation& f) {
  const Model& model = f.model();
  f.find_links();
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    const Ports ports = f.ports(k);
    const bool follows = std::ranges::any_of(e.signals, [&](const Signal& signal) {
      return signal.link >= 0 && std::isnan(ports.links[signal.link]);
    });
    if (follows) continue;
    const auto complaint = element_kind(e.type).complaint;
    std::string why = complaint ? complaint(ports) : std::string();
    std::string owner = element_name(e);
    for (const Signal& signal : e.signals) {
      if (signal.function.formula && why.empty()) why = fault_at(*signal.function.formula, ports.t);
      if (!signal.local || !why.empty()) continue;
      why = local_formula_complaint(ports, f.effort(k).length, f.effort(k).rate);
      owner = "formula '" + signal.local->name + "'";
    }
    if (!why.empty()) return owner + ": " + why;
  }
  return {};
}

std::string overflow_sentence(const std::string& text, double t, double limit) {
  if (text.starts_with(undefined_mark)) return fmt::format("{} at t = {:.6g} s", text, t);
  return fmt::format(
      "the numbers of the model overflow: {} at t = {:.6g} s, expected less than {:g}", text, t,
      limit);
}

std::string thrown_text(const std::exception_ptr& thrown) {
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "of an unknown type";
  }
}

std::string thrown_sentence(const Formulation& f, double t) {
  const auto& [element, exception] = f.thrown();
  return fmt::format("the law of '{}' threw an exception at t = {:.9g} s: {}",
                     f.model().elements[element].name, t, thrown_text(exception));
}

void require_laws(const Formulation& f, double t) {
  if (f.thrown().element >= 0)
    throw RunError(ErrorCode::step_failed, thrown_sentence(f, t), f.thrown().exception);
  if (f.element_states().follow() || f.element_states().unsolved() < 0) return;
  throw RunError(
      ErrorCode::no_convergence,
      fmt::format("the signals in the ring of {} have no solution at t = {:.9g} s: their "
                  "gains cancel",
                  element_name(f.model().elements[f.element_states().unsolved()]), t));
}

}  // namespace floatframe
