#pragma once
// Monitors deformation, spin and phase of a run in any formulation, from a formulation whose
// positions and velocities are those of the state. Nothing here allocates after construction; the
// formulation and the state are not changed.
#include <map>
#include <vector>

#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/integrator/augmented_lagrangian.hpp"
#include "floatframe/simulation/body_energy.hpp"
#include "floatframe/simulation/range_watch.hpp"

namespace floatframe {

template <class F>
class MotionWatch {
 public:
  MotionWatch(F& formulation, double step) : f_(formulation), range_(formulation.model(), step) {
    int modes = 0;
    for (const Body& b : f_.model().bodies) modes = std::max(modes, b.modes());
    y_ = ydot_ = VecX::Zero(modes);
    std::map<std::pair<const FlexibleBody*, bool>, std::size_t> known;
    for (const Body& b : f_.model().bodies) {
      const auto [at, fresh] =
          known.emplace(std::pair(b.data.get(), b.stiffens()), energies_.size());
      if (fresh)
        energies_.emplace_back(b.data->invariants,
                               second_order_on_masses(*b.data, b.stiffens()).get());
      energy_.push_back(at->second);
    }
  }

  const RangeWatch& range() const noexcept { return range_; }
  template <class Stream>
  void serialize(Stream& s) {
    range_.serialize(s);
  }

  /// Deformation, spin and rotation of all bodies.
  void look(const State& s) noexcept {
    for (std::size_t i = 0; i < range_.bodies().size(); ++i) {
      const int body = static_cast<int>(i);
      for (int k = 0; k < f_.model().bodies[i].modes(); ++k) y_[k] = f_.amplitude(s.q, body, k);
      const Vec3 w = f_.body_rotation(body).transpose() * f_.body_angular_velocity(body);
      range_.bodies()[i].observe(s.t, range_.step(), w, y_.data(), range_.limits());
    }
  }

  /// For each flexible body: its largest elastic displacement, and the largest due to a single mode
  /// [m].
  void deformations(const State& s, double* out) noexcept {
    for (std::size_t i = 0; i < range_.bodies().size(); ++i) {
      const int modes = f_.model().bodies[i].modes();
      if (modes == 0) continue;
      for (int k = 0; k < modes; ++k) y_[k] = f_.amplitude(s.q, static_cast<int>(i), k);
      const BodyRange& body = range_.bodies()[i];
      *out++ = body.displacement_now(y_.data());
      *out++ = body.displacement_of_one_mode(y_.data());
    }
  }

  /// For all bodies [J].
  double kinetic_energy(const State& s) noexcept {
    double sum = 0.0;
    for (std::size_t i = 0; i < energy_.size(); ++i) {
      const int body = static_cast<int>(i);
      for (int k = 0; k < f_.model().bodies[i].modes(); ++k) {
        y_[k] = f_.amplitude(s.q, body, k);
        ydot_[k] = f_.amplitude_rate(s.v, body, k);
      }
      const Mat3 R_BW = f_.body_rotation(body).transpose();
      sum += energies_[energy_[i]].kinetic(R_BW * f_.body_velocity(body),
                                           R_BW * f_.body_angular_velocity(body), y_.data(),
                                           ydot_.data());
    }
    return sum;
  }

  /// Velocities at the start and after every full step.
  void start(const State& s) noexcept {
    meters(s, [](PhaseMeter& m, const Vec3& v) { m.start(v); });
    range_.turns().start(f_);
  }
  void follow(const State& s) noexcept {
    meters(s, [](PhaseMeter& m, const Vec3& v) { m.observe(v); });
    range_.turns().follow(f_, s.t);
  }

 private:
  template <class Use>
  void meters(const State& s, const Use& use) noexcept {
    for (std::size_t i = 0; i < f_.model().bodies.size(); ++i) {
      const int body = static_cast<int>(i);
      std::vector<PhaseMeter>& m = range_.meters(body);
      use(m[0], f_.body_velocity(body));
      use(m[1], f_.body_angular_velocity(body));
      for (std::size_t k = 2; k < m.size(); ++k)
        use(m[k], Vec3(f_.amplitude_rate(s.v, body, static_cast<int>(k) - 2), 0.0, 0.0));
    }
  }

  F& f_;
  RangeWatch range_;
  VecX y_, ydot_;
  std::vector<BodyEnergy> energies_;  ///< one for equal bodies
  std::vector<std::size_t> energy_;   ///< index for each body
};

}  // namespace floatframe
