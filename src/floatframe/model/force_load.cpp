// Applied force or torque on b: direction x (magnitude(t) + input). A direction that follows the
// body turns with it: dF = dpi_b x F. A fixed one has no tangent.
#include "floatframe/model/force_kind.hpp"

namespace floatframe {

namespace {

Vec3 load(const ForceInput& in, double magnitude) noexcept {
  return magnitude * (in.force.follows ? Vec3(in.b.R * in.force.axis) : in.force.axis);
}

}  // namespace

template <>
void force_of<ForceType::force>(const ForceInput& in, ForceState& out) noexcept {
  out.force = in.magnitude();
  out.wrench.Fb = load(in, out.force);
}

template <>
void force_of<ForceType::torque>(const ForceInput& in, ForceState& out) noexcept {
  out.force = in.magnitude();
  out.wrench.Tb = load(in, out.force);
}

namespace {

/// -dF/dpi_b = skew(F)
Mat3 turning(const ForceInput& in) noexcept {
  if (!in.force.follows) return Mat3::Zero();
  return skew(load(in, in.magnitude()));
}

}  // namespace

template <>
void force_tangent_of<ForceType::force>(const ForceInput& in, ForceTangent& out) noexcept {
  out.K.block<3, 3>(part_of::r_b, part_of::pi_b) = turning(in);
}

template <>
void force_tangent_of<ForceType::torque>(const ForceInput& in, ForceTangent& out) noexcept {
  out.K.block<3, 3>(part_of::pi_b, part_of::pi_b) = turning(in);
}

namespace {

// The tangent of a following torque is antisymmetric: the rows leave nothing symmetric out.
constexpr ForceRegime regimes_of_force[] = {
    {.name = "fixed", .conservative = false},
    {.name = "following",
     .rows_leave_out = "the turning of the load with its body",
     .conservative = false}};
constexpr ForceRegime regimes_of_torque[] = {{.name = "fixed", .conservative = false},
                                             {.name = "following", .conservative = false}};

ForceExample example(ForceType type, std::size_t regime, ExampleNumbers& numbers) {
  ForceExample x;
  x.force.type = type;
  x.force.follows = regime == 1;
  x.force.axis = numbers.vector(2.0);
  add_example_drive(x, numbers);
  x.a = x.b = numbers.marker();
  return x;
}

ForceExample example_of_force(std::size_t regime, ExampleNumbers& numbers) {
  return example(ForceType::force, regime, numbers);
}

ForceExample example_of_torque(std::size_t regime, ExampleNumbers& numbers) {
  return example(ForceType::torque, regime, numbers);
}

}  // namespace

const ForceKind applied_force_kind{ForceType::force,
                                   "force",
                                   false,
                                   force_of<ForceType::force>,
                                   force_tangent_of<ForceType::force>,
                                   regimes_of_force,
                                   example_of_force};
const ForceKind applied_torque_kind{ForceType::torque,
                                    "torque",
                                    false,
                                    force_of<ForceType::torque>,
                                    force_tangent_of<ForceType::torque>,
                                    regimes_of_torque,
                                    example_of_torque};

}  // namespace floatframe
