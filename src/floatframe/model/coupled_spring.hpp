#pragma once
// A coupling of two angles that gives way, with its factor c and the play b:
//   s = q_1 + c q_2,  f = k (s -+ b/2) + d sdot in contact, beyond the play, not against it;
//   0 within it                                                                               (1)
//   torques   -f z_1, -f c z_2 on the wheels, f z_1, f c z_2 on the housing
//   row       k g g^T and the damping d g g^T, g = (-z_1, z_1, -c z_2, c z_2)
//   branches  the three stretches of the spring
// Steps run it: no heap, noexcept.
#include "floatframe/model/axis_measure.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

struct CoupledSpring {
  PiecewisePolynomial spring;  ///< of s [rad] -> [N m], about the axis of the first wheel
  double damping = 0.0;        ///< d [N m s/rad]
  double factor = 1.0;         ///< c
};

/// The spring of (1).
PiecewisePolynomial spring_with_play(double stiffness, double play);

template <class S>
struct CoupledStretch {
  S s, rate;
  Eigen::Matrix<S, 3, 1> z_1, z_2;
};
template <class S>
CoupledStretch<S> coupled_stretch(const PortsOf<S>& in, double factor) noexcept {
  CoupledStretch<S> x;
  const auto angle = [&](int port) {
    return angle_about_z<S>(in.marker(port), in.marker(port + 1),
                            in.angles ? in.angles[port / 2] : 0.0);
  };
  x.z_1 = in.marker(0).R.col(2);
  x.z_2 = in.marker(2).R.col(2);
  x.s = angle(0) + factor * angle(2);
  x.rate = x.z_1.dot(in.marker(1).w - in.marker(0).w) +
           factor * x.z_2.dot(in.marker(3).w - in.marker(2).w);
  return x;
}

/// (1). The force that it gives is the torque on the first wheel.
template <class S>
void pull_coupled(const PortsOf<S>& in, const CoupledSpring& k, EffortsOf<S>& out) noexcept {
  const auto [s, rate, z_1, z_2] = coupled_stretch(in, k.factor);
  out.length = s;
  out.rate = rate;
  const std::size_t stretch = in.branch == free_branch ? k.spring.stretch_index(value_of(s))
                                                       : static_cast<std::size_t>(in.branch);
  const LawValue<S> spring = law_of(k.spring, stretch, s);
  out.energy = energy_of(k.spring, s);
  out.energy_rate = spring.f * rate;
  const S damped = spring.f + k.damping * rate;
  const bool play = !k.spring.edges().empty();
  const bool pushes = !play || (stretch == 0 ? -1.0 : 1.0) * value_of(damped) > 0.0;
  const S f = spring.df > 0.0 && pushes ? damped : S(0.0);
  out.force = -f;
  out.damping = (f - spring.f) * rate;
  if (!(spring.df > 0.0 && pushes)) return;
  const S c = k.factor;
  out.wrench[0].T = f * z_1;
  out.wrench[1].T = -f * z_1;
  out.wrench[2].T = f * c * z_2;
  out.wrench[3].T = -f * c * z_2;
  if constexpr (std::is_same_v<S, double>) {
    Wrench* g = out.add_row(spring.df, k.damping);
    g[0] = {Vec3::Zero(), -z_1};
    g[1] = {Vec3::Zero(), z_1};
    g[2] = {Vec3::Zero(), -k.factor * z_2};
    g[3] = {Vec3::Zero(), k.factor * z_2};
  }
}

inline BranchSide coupled_side(const Ports& in, const CoupledSpring& k) noexcept {
  const double s = coupled_stretch(in, k.factor).s;
  if (in.branch == free_branch) return {-1.0, static_cast<std::int64_t>(k.spring.stretch_index(s))};
  const StretchSide side = stretch_side(k.spring, static_cast<std::size_t>(in.branch), s);
  return {side.beyond, static_cast<std::int64_t>(side.next)};
}

/// Elastic, on a flank and within the play, behind a regime that holds.
inline constexpr const char* turning_wheel_axes = "the turning of the axes with their bodies";
inline constexpr ElementRegime coupled_spring_regimes[] = {
    {.name = "holding", .acts = false},
    {.name = "elastic", .rows_leave_out = turning_wheel_axes},
    {.name = "on_a_flank", .rows_leave_out = turning_wheel_axes},
    {.name = "within_the_play", .acts = false}};
/// Markers and spring of one of these regimes.
CoupledSpring coupled_spring_example(std::size_t regime, ElementExample& x,
                                     ExampleNumbers& numbers);

}  // namespace floatframe
