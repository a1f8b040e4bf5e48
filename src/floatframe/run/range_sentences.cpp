// Messages of the range checks: one sentence per kind of limit, about the body that exceeded it
// most.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/run/energy_cause.hpp"
#include "floatframe/run/range_watch.hpp"

namespace floatframe {
namespace {

/// The body with the largest value relative to its limit, and the number of others above theirs.
struct Worst {
  int body = -1, others = -1;
  double ratio = 1.0;
  void offer(int i, double r) {
    if (!(r > 1.0)) return;
    ++others;
    if (r > ratio) {
      ratio = r;
      body = i;
    }
  }
  explicit operator bool() const { return body >= 0; }
};

std::string percent(double x) { return fmt::format("{:.3g} %", 100.0 * x); }

/// The neglected part of the stiffness of a body at a spin [rad/s].
std::string tension_text(const BodyRange& body, double spin) {
  const double ratio = spin / body.lowest_frequency();
  if (body.stiffening() > 0.0)
    return fmt::format(
        "centrifugal tension, which is left out here, would raise its lowest stiffness by about "
        "{}; geometric_stiffening: true counts it in",
        percent(body.stiffening() * spin * spin));
  return fmt::format(
      "centrifugal tension does not stiffen it here, which leaves its frequencies in error by "
      "about {} (the square of the ratio)",
      percent(ratio * ratio));
}

class Writer {
 public:
  Writer(const Model& model, const std::vector<BodyRange>& bodies, double step,
         const RangeLimits& limits, std::span<const TimeCorner> corners = {})
      : model_(model), bodies_(bodies), step_(step), limits_(limits), corners_(corners) {}

  void displacement(std::vector<RangeWarning>& out) const {
    about_worst(
        RangeLimit::displacement, &BodyRange::displacement,
        [&](const BodyRange& b) { return limits_.displacement * b.size(); },
        [&](const std::string& body, const BodyRange& b, const Largest& x) {
          if (at_rest())
            return fmt::format(
                "{} deforms too far for small deformations: in the equilibrium {} is displaced by "
                "{:.3g} m ({}) in the body frame, more than {} of its size of {:.3g} m; divide it "
                "into several bodies",
                body, b.node_name(x.node), x.value, percent(x.value / b.size()),
                percent(limits_.displacement), b.size());
          return fmt::format(
              "{} deforms too far for small deformations: from t = {:.4g} s on by more than {} of "
              "its size of {:.3g} m, at t = {:.4g} s {} is displaced by {:.3g} m ({}) in the body "
              "frame; divide it into several bodies",
              body, x.first, percent(limits_.displacement), b.size(), x.at, b.node_name(x.node),
              x.value, percent(x.value / b.size()));
        },
        out);
  }

  void rotation(std::vector<RangeWarning>& out) const {
    about_worst(
        RangeLimit::rotation, &BodyRange::rotation,
        [&](const BodyRange&) { return limits_.rotation; },
        [&](const std::string& body, const BodyRange& b, const Largest& x) {
          if (at_rest())
            return fmt::format(
                "{} bends too far for small rotations: in the equilibrium {} is turned by {:.3g} "
                "rad in the body frame, more than {:g} rad; divide it into several bodies",
                body, b.node_name(x.node), x.value, limits_.rotation);
          return fmt::format(
              "{} bends too far for small rotations: from t = {:.4g} s on by more than {:g} rad, "
              "at t = {:.4g} s {} is turned by {:.3g} rad in the body frame; divide it into "
              "several bodies",
              body, x.first, limits_.rotation, x.at, b.node_name(x.node), x.value);
        },
        out);
  }

  void spin(std::vector<RangeWarning>& out) const {
    about_worst(
        RangeLimit::spin, &BodyRange::spin,
        [&](const BodyRange& b) { return limits_.spin * b.lowest_frequency(); },
        [&](const std::string& body, const BodyRange& b, const Largest& x) {
          return fmt::format(
              "{} spins too fast for its stiffness: from t = {:.4g} s on at more than {:g} times "
              "its lowest frequency of {:.4g} rad/s, at t = {:.4g} s at {:.4g} rad/s; {}{}",
              body, x.first, limits_.spin, b.lowest_frequency(), x.at, x.value,
              tension_text(b, x.value),
              b.stiffening() > 0.0 ? "" : "; divide it into several bodies");
        },
        out);
  }

  void turn(std::vector<RangeWarning>& out) const {
    about_worst(
        RangeLimit::turn, &BodyRange::turn, [&](const BodyRange&) { return limits_.turn; },
        [&](const std::string& body, const BodyRange&, const Largest& x) {
          return fmt::format(
              "{} turns too far in one step of {:g} s: from t = {:.4g} s on by more than {:g} rad, "
              "at t = {:.4g} s by {:.3g} rad; take a step of at most {:.2g} s",
              body, step_, x.first, limits_.turn, x.at, x.value, step_ * limits_.turn / x.value);
        },
        out);
  }

  void phase(const std::vector<std::vector<PhaseMeter>>& meters,
             std::vector<RangeWarning>& out) const {
    double all = 0.0, elastic = 0.0;
    for (const auto& body : meters)
      for (std::size_t k = 0; k < body.size(); ++k) {
        all += body[k].energy();
        if (k >= 2) elastic += body[k].energy();
      }
    Worst worst;
    std::size_t what = 0;
    for (std::size_t i = 0; i < meters.size(); ++i) {
      double furthest = 0.0;
      for (std::size_t k = 0; k < meters[i].size(); ++k) {
        const PhaseMeter& m = meters[i][k];
        // Too few steps give no estimate; vibrations are compared among themselves if significant.
        const bool counts =
            m.energy() > limits_.share * all ||
            (k >= 2 && elastic > least_vibration * all && m.energy() > limits_.share * elastic);
        if (m.count() < least_steps || m.speed() * step_ < least_motion || !counts ||
            m.phase() <= furthest)
          continue;
        furthest = m.phase();
        if (furthest / limits_.phase > worst.ratio) what = k;
      }
      worst.offer(static_cast<int>(i), furthest / limits_.phase);
    }
    if (!worst) return;
    const PhaseMeter& m = meters[worst.body][what];
    const std::string motion = what == 0   ? "the motion of "
                               : what == 1 ? "the turning of "
                                           : fmt::format("mode {} of ", what - 1);
    out.push_back(
        {RangeLimit::phase,
         fmt::format(
             "the step of {:g} s is too long for {}{}: it goes through {:.3g} rad of phase in each "
             "step (limit {:g} rad), {:.2g} steps per period, and carries {} of the kinetic energy "
             "of {}; take a step of at most {:.2g} s",
             step_, motion, subject(worst), m.phase(), limits_.phase,
             2.0 * std::numbers::pi / m.phase(),
             percent(m.energy() / (what >= 2 && elastic > 0.0 ? elastic : all)),
             what >= 2 ? "all vibrations" : "all oscillations",
             step_ * std::tan(0.5 * limits_.phase) / std::tan(0.5 * std::min(m.phase(), 3.0)))});
  }

  void balance(const EnergySummary& e, double spectral_radius,
               std::vector<RangeWarning>& out) const {
    if (!e.balanced) return;
    const double x = std::abs(e.largest_remainder), part = x / e.exchanged;
    // A small fraction of the total energy is an error due to the step size, even if little energy
    // is exchanged.
    if (!(x > limits_.of_present * e.present)) return;
    // With numerical damping a loss is expected, unless it is large.
    const bool damped = spectral_radius < 1.0 && e.largest_remainder < 0.0;
    if (damped && part > limits_.dissipation)
      out.push_back(
          {RangeLimit::damping,
           fmt::format(
               "the numerical damping of the integrator (spectral radius {:g}) has removed {:.4g} "
               "J from the system by t = {:.4g} s, {} of the {:.4g} J exchanged (limit {}); {}",
               spectral_radius, x, e.largest_remainder_at, percent(part), e.exchanged,
               percent(limits_.dissipation), remedy(e, " or a spectral radius nearer to 1"))});
    if (!damped && part > limits_.imbalance)
      out.push_back(
          {RangeLimit::balance,
           fmt::format("the energy balance does not close: at t = {:.4g} s the system has {:.4g} J "
                       "{} than the work of all forces and motions explains, {} of the {:.4g} J "
                       "exchanged (limit {}); {}",
                       e.largest_remainder_at, x, e.largest_remainder > 0.0 ? "more" : "less",
                       percent(part), e.exchanged, percent(limits_.imbalance),
                       remedy(e, gain_of_vibrations(e, spectral_radius)
                                     ? ", or a spectral radius of 0.8: vibrations that steps do "
                                       "not resolve may gain energy without bound"
                                     : ""))});
  }

 private:
  /// The cause of the imbalance, if it can be identified; else the step size.
  std::string remedy(const EnergySummary& e, const char* or_else) const {
    const std::string cause =
        energy_cause(model_, e.largest_growth_from, e.largest_growth_to, step_, corners_);
    if (cause.empty()) return fmt::format("take a smaller step than {:g} s{}", step_, or_else);
    return fmt::format("{:.4g} J of it appear between t = {:.4g} and {:.4g} s, where {}",
                       e.largest_growth, e.largest_growth_from, e.largest_growth_to, cause);
  }

  /// The trapezoidal rule does not damp unresolved motions.
  bool gain_of_vibrations(const EnergySummary& e, double spectral_radius) const {
    return e.largest_remainder > 0.0 && spectral_radius == 1.0 &&
           std::any_of(model_.bodies.begin(), model_.bodies.end(),
                       [](const Body& b) { return b.modes() > 0; });
  }

  static constexpr long least_steps = 6;
  static constexpr double least_vibration = 1e-4;

  /// The sentence about the body that exceeds its limit most; a limit of 0 is none.
  template <class Limit, class Sentence>
  void about_worst(RangeLimit kind, const Largest& (BodyRange::*measure)() const,
                   const Limit& limit, const Sentence& sentence,
                   std::vector<RangeWarning>& out) const {
    Worst worst;
    for (std::size_t i = 0; i < bodies_.size(); ++i)
      if (limit(bodies_[i]) > 0.0)
        worst.offer(static_cast<int>(i), (bodies_[i].*measure)().value / limit(bodies_[i]));
    if (!worst) return;
    const BodyRange& b = bodies_[worst.body];
    out.push_back({kind, sentence(subject(worst), b, (b.*measure)())});
  }

  bool at_rest() const { return step_ == 0.0; }

  std::string subject(const Worst& worst) const {
    const std::string name = "body '" + model_.bodies[worst.body].name + "'";
    if (worst.others == 0) return name;
    return fmt::format("{} (and {} more)", name, worst.others);
  }

  const Model& model_;
  const std::vector<BodyRange>& bodies_;
  double step_;
  const RangeLimits& limits_;
  std::span<const TimeCorner> corners_;
};

}  // namespace

std::string spin_sentence(const Model& model, const BodyRange& range, int body, const Vec3& w) {
  const double spin = range.loading_spin(w);
  return fmt::format(
      "body '{}' spins too fast for its stiffness: at {:.4g} rad/s, {:.3g} times its lowest "
      "frequency of {:.4g} rad/s; {}",
      model.bodies[static_cast<std::size_t>(body)].name, spin, spin / range.lowest_frequency(),
      range.lowest_frequency(), tension_text(range, spin));
}

std::vector<RangeWarning> equilibrium_warnings(const Model& model,
                                               const std::vector<StaticsBody>& bodies,
                                               const RangeLimits& limits) {
  std::vector<BodyRange> ranges;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    ranges.emplace_back(model, static_cast<int>(i));
    if (model.bodies[i].modes() > 0)
      ranges.back().observe(0.0, 0.0, Vec3::Zero(), bodies[i].amplitudes.data(), limits);
  }
  const Writer writer(model, ranges, 0.0, limits);
  std::vector<RangeWarning> out;
  writer.displacement(out);
  writer.rotation(out);
  return out;
}

std::vector<RangeWarning> RangeWatch::warnings(const EnergySummary& energy, double spectral_radius,
                                               std::span<const TimeCorner> corners) const {
  const Writer writer(model_, bodies_, step_, limits_, corners);
  std::vector<RangeWarning> out;
  writer.displacement(out);
  writer.rotation(out);
  writer.spin(out);
  writer.turn(out);
  writer.phase(meters_, out);
  writer.balance(energy, spectral_radius, out);
  turns_.warn(out);
  return out;
}

}  // namespace floatframe
