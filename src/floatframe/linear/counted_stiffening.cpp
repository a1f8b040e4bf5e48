#include "floatframe/linear/counted_stiffening.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "floatframe/core/plural.hpp"
#include "floatframe/formulation/relative.hpp"
#include "floatframe/loops/run_error.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/run/range_watch.hpp"
#include "floatframe/start/start_up.hpp"
#include "floatframe/tangents/mass_scale.hpp"
#include "floatframe/tangents/small_motions.hpp"

namespace floatframe {
namespace {

/// Fraction of the stiffness of a body below which that of its loads is neglected.
constexpr double least_part = 1e-6;

bool lacks_nodes(const Body& b) { return b.data->projection && b.data->projection->h.size() == 0; }

/// True if geometric stiffening is possible, perhaps by preprocessing instead of projection.
bool can_stiffen(const Model& model, const Body& b) {
  if (b.modes() == 0 || !b.data->second_order) return false;
  if (model.simulation.inertia != InertiaMethod::projection || !lacks_nodes(b)) return true;
  return std::none_of(model.bodies.begin(), model.bodies.end(), [](const Body& other) {
    return other.modes() > 0 && other.data->mass_model == MassModel::six_dof;
  });
}

bool asked_without(const Body& b) { return b.stiffening_given && !b.geometric_stiffening; }
bool candidate(const Model& model, const Body& b) {
  return !b.stiffening_given && can_stiffen(model, b);
}

void stiffen(Model& model, std::size_t body) {
  Body& b = model.bodies[body];
  b.geometric_stiffening = true;
  if (lacks_nodes(b)) model.simulation.inertia = InertiaMethod::preprocessing;
}

std::string named_bodies(const std::vector<std::string>& bodies) {
  std::string text = bodies.size() == 1 ? "body " : "bodies ";
  const std::size_t shown = std::min<std::size_t>(bodies.size(), 5);
  for (std::size_t k = 0; k < shown; ++k)
    text += fmt::format("{}'{}'", k == 0 ? "" : ", ", bodies[k]);
  if (shown < bodies.size()) text += fmt::format(" and {} more", bodies.size() - shown);
  return text;
}

/// Fills `bodies` and `sentence` from the model.
void name_bodies(CountedStiffening& c) {
  c.bodies.clear();
  for (const Body& b : c.model.bodies)
    if (!b.stiffening_given && b.stiffens()) c.bodies.push_back(b.name);
  c.sentence = c.bodies.empty()
                   ? ""
                   : fmt::format(
                         "Geometric stiffening by loads and spin is counted in here ({}); 'run' "
                         "leaves it out unless the model sets geometric_stiffening: true",
                         named_bodies(c.bodies));
}

/// Bodies for which the effect of geometric stiffening can be computed: with it, or without.
Model stiffened(const Model& model, bool with) {
  Model out = model;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (can_stiffen(model, model.bodies[i])) stiffen(out, i);
  for (Body& b : out.bodies) b.geometric_stiffening = with && b.geometric_stiffening;
  return out;
}

/// d(M a - Q + Phi_q^T lambda)/dy for the amplitudes of bodies in a started model.
class ModalStiffness {
 public:
  ModalStiffness(const Model& model, const State& state)
      : model_(model), s_(state), f_(model_, model_.simulation.inertia) {
    a_ = s_.a.size() == f_.velocities() ? s_.a : VecX::Zero(f_.velocities());
    steps_ = motion_steps(model_, possible_masses(f_, s_));
  }

  MatX of(std::size_t body) {
    std::vector<int> columns(static_cast<std::size_t>(model_.bodies[body].modes()));
    std::iota(columns.begin(), columns.end(), f_.body_coordinates(static_cast<int>(body)).yd);
    MatX K(columns.size(), columns.size());
    VecX x = VecX::Zero(f_.velocities()), q = s_.q, ahead = x, behind = x;
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const double h = steps_[columns[k]];
      for (const double sign : {1.0, -1.0}) {
        x[columns[k]] = sign * h;
        f_.retract(s_.q, x, q);
        kinematics_at(f_, s_.t, q, s_.v);
        f_.dynamics();
        f_.residual(a_, s_.lambda, 0.0, sign > 0.0 ? ahead : behind);
      }
      x[columns[k]] = 0.0;
      const VecX slope = (ahead - behind) / (2.0 * h);
      K.col(static_cast<Eigen::Index>(k)) = slope(columns);
    }
    return K;
  }

 private:
  const Model model_;
  const State& s_;
  RelativeFormulation f_;
  VecX a_, steps_;
};

/// The start of the model, and the effect of loads and spin on the stiffness of its bodies there.
class OperatingPoint {
 public:
  explicit OperatingPoint(const Model& model)
      : model_(model), start_(model, model.simulation, Coordinates::relative) {}

  /// The largest relative change of the stiffness of a body by geometric stiffening.
  double part(std::size_t body) {
    if (!with_) {
      with_.emplace(stiffened(start_.model(), true), start_.state());
      without_.emplace(stiffened(start_.model(), false), start_.state());
    }
    const MatX difference = with_->of(body) - without_->of(body);
    const MatX& K = model_.bodies[body].data->K;
    const SymmetricEigen parts =
        generalised_eigenvalues(0.5 * (difference + difference.transpose()), K);
    return parts.found ? parts.values.cwiseAbs().maxCoeff() : difference.norm() / K.norm();
  }

  /// In body axes [rad/s].
  Vec3 spin(std::size_t body) {
    kinematics_at(start_.formulation(), start_.state());
    const BodyKinematics& b = start_.formulation().motion().bodies[body];
    return b.R_WB.transpose() * b.w_WB;
  }

 private:
  const Model& model_;
  InitialisedModel start_;
  std::optional<ModalStiffness> with_, without_;
};

/// A body for which it is switched off or not available.
void note_body(const Model& model, std::size_t body, OperatingPoint& at,
               std::vector<std::string>& notes) {
  const Body& b = model.bodies[body];
  const BodyRange range(model, static_cast<int>(body));
  const double limit = RangeLimits{}.spin;
  const Vec3 w = at.spin(body);
  const double lowest = range.lowest_frequency();
  if (!(lowest > 0.0)) return;
  const double across = range.loading_spin(w) / lowest;
  if (b.data->mass_model == MassModel::six_dof && w.norm() > 1e-3 * lowest)
    notes.push_back(
        fmt::format("body '{}' spins at {:.4g} rad/s, and mass_model six_dof has no second order "
                    "of its turning sections: whirl at speed is in error; mass_model: hermite with "
                    "section_inertia: true has it",
                    b.name, w.norm()));
  if (!asked_without(b)) {
    if (can_stiffen(model, b) || b.stiffens() || !(across > limit)) return;
    notes.push_back(fmt::format(
        "body '{}' spins at {:.4g} rad/s, {:.3g} times its lowest frequency of {:.4g} rad/s, and "
        "what that does to its stiffness is left out: {}",
        b.name, range.loading_spin(w), across, lowest,
        !b.data->second_order                      ? "it is not known"
        : b.data->mass_model == MassModel::six_dof ? "geometric_stiffening: true counts it in"
                                                   : "inertia: preprocessing counts it in"));
    return;
  }
  if (across > limit) {
    notes.push_back(spin_sentence(model, range, static_cast<int>(body), w));
  } else if (can_stiffen(model, b)) {
    const double part = at.part(body);
    if (part > limit * limit)
      notes.push_back(
          fmt::format("loads change the stiffness of body '{}' by up to {:.3g} %, which is left "
                      "out here; geometric_stiffening: true counts it in",
                      b.name, 100.0 * part));
  }
}

}  // namespace

CountedStiffening counted_stiffening(const Model& model) {
  CountedStiffening c{model, {}, "", {}};
  std::vector<std::size_t> asked;
  bool watched = false;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (model.bodies[i].modes() == 0) continue;
    watched = true;
    if (!candidate(model, model.bodies[i]) || model.bodies[i].geometric_stiffening) continue;
    asked.push_back(i);
    stiffen(c.model, i);
  }
  if (!watched) return c;
  std::optional<OperatingPoint> at;
  try {
    at.emplace(c.model);
  } catch (const RunError&) {
    if (asked.empty()) throw;
    c.model = model;
    at.emplace(c.model);
    c.notes.push_back("with geometric stiffening no start is found: it is left out");
    asked.clear();
  }
  std::vector<std::size_t> small;
  for (const std::size_t i : asked)
    if (!(at->part(i) > least_part)) small.push_back(i);
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (model.bodies[i].modes() > 0) note_body(model, i, *at, c.notes);
  at.reset();
  if (small.size() == asked.size()) c.model.simulation.inertia = model.simulation.inertia;
  for (const std::size_t i : small) c.model.bodies[i].geometric_stiffening = false;
  name_bodies(c);
  return c;
}

CountedStiffening counted_stiffening(const Model& model, const std::vector<int>& bodies) {
  CountedStiffening c{model, {}, "", {}};
  for (const int i : bodies) {
    const Body& b = model.bodies[static_cast<std::size_t>(i)];
    if (candidate(model, b)) stiffen(c.model, static_cast<std::size_t>(i));
  }
  name_bodies(c);
  return c;
}

}  // namespace floatframe
