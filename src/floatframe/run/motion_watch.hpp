#pragma once
// Monitors deformation, spin and phase of a run, from the motion after each step. Nothing here
// allocates after construction.
#include <cassert>
#include <map>
#include <vector>

#include "floatframe/body/second_order_on_masses.hpp"
#include "floatframe/model/system_motion.hpp"
#include "floatframe/run/body_energy.hpp"
#include "floatframe/run/range_watch.hpp"

namespace floatframe {

class MotionWatch {
 public:
  MotionWatch(const Model& model, double step) : range_(model, step) {
    std::map<std::pair<const FlexibleBody*, bool>, std::size_t> known;
    for (const Body& b : model.bodies) {
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
  void look(const SystemMotion& motion) noexcept {
    assert(motion.bodies.size() == range_.bodies().size());
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
      const BodyKinematics& b = motion.bodies[i];
      const Vec3 w = b.R_WB.transpose() * b.w_WB;
      range_.bodies()[i].observe(motion.t, range_.step(), w, b.y.data(), range_.limits());
    }
  }

  /// For each flexible body: its largest elastic displacement, and the largest due to a single mode
  /// [m].
  void deformations(const SystemMotion& motion, double* out) noexcept {
    assert(motion.bodies.size() == range_.bodies().size());
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
      const BodyKinematics& b = motion.bodies[i];
      if (b.y.size() == 0) continue;
      const BodyRange& body = range_.bodies()[i];
      *out++ = body.displacement_now(b.y.data());
      *out++ = body.displacement_of_one_mode(b.y.data());
    }
  }

  /// For all bodies [J].
  double kinetic_energy(const SystemMotion& motion) noexcept {
    assert(motion.bodies.size() == energy_.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
      const BodyKinematics& b = motion.bodies[i];
      const Mat3 R_BW = b.R_WB.transpose();
      sum += energies_[energy_[i]].kinetic(R_BW * b.v_WB, R_BW * b.w_WB, b.y.data(), b.yd.data());
    }
    return sum;
  }

  /// Velocities at the start and after every full step.
  void start(const SystemMotion& motion) noexcept {
    meters(motion, [](PhaseMeter& m, const Vec3& v) { m.start(v); });
    range_.turns().start(motion);
  }
  void follow(const SystemMotion& motion) noexcept {
    meters(motion, [](PhaseMeter& m, const Vec3& v) { m.observe(v); });
    range_.turns().follow(motion);
  }

 private:
  template <class Use>
  void meters(const SystemMotion& motion, const Use& use) noexcept {
    for (std::size_t i = 0; i < motion.bodies.size(); ++i) {
      const BodyKinematics& b = motion.bodies[i];
      std::vector<PhaseMeter>& m = range_.meters(static_cast<int>(i));
      assert(std::ssize(m) == 2 + b.yd.size());
      use(m[0], b.v_WB);
      use(m[1], b.w_WB);
      for (std::size_t k = 2; k < m.size(); ++k)
        use(m[k], Vec3(b.yd[static_cast<Eigen::Index>(k) - 2], 0.0, 0.0));
    }
  }

  RangeWatch range_;
  std::vector<BodyEnergy> energies_;  ///< one for equal bodies
  std::vector<std::size_t> energy_;   ///< index for each body
};

}  // namespace floatframe
