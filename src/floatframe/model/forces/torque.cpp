// Applied torque on b: direction x (magnitude(t) + input). A direction that follows the body
// rotates with it: dT = dpi_b x T, so -dT/dpi_b = skew(T), which is antisymmetric: the rows omit no
// symmetric term. A fixed direction has no tangent.
#include "floatframe/model/force_kind.hpp"

namespace floatframe {

template <>
void force_of<ForceType::torque>(const ForceInput& in, ForceState& out) noexcept {
  out.force = in.magnitude();
  out.wrench.Tb = in.load(out.force);
}

template <>
void force_tangent_of<ForceType::torque>(const ForceInput& in, ForceTangent& out) noexcept {
  if (in.force.follows)
    out.K.block<3, 3>(part_of::pi_b, part_of::pi_b) = skew(in.load(in.magnitude()));
}

namespace {

constexpr auto torque_keys = load_keys(ForceAxis::about);

bool torque_build(ForceBuild& b) { return b.load(true); }

constexpr ForceRegime torque_regimes[] = {{.name = "fixed", .conservative = false},
                                          {.name = "following", .conservative = false}};

ForceExample torque_example(std::size_t regime, ExampleNumbers& numbers) {
  return example_load(ForceType::torque, regime == 1, numbers);
}

}  // namespace

constinit const ForceKind torque_element = {.about = "torque on a body",
                                            .keys = torque_keys,
                                            .markers = ForceMarkers::one,
                                            .energy = EnergyCategory::loads,
                                            .axis = ForceAxis::about,
                                            .measured = false,
                                            .blank =
                                                [] {
                                                  AppliedLoadDescription load;
                                                  load.torque = true;
                                                  return ForceDescription::Values(load);
                                                },
                                            .build = torque_build,
                                            .regimes = torque_regimes,
                                            .example = torque_example};

}  // namespace floatframe
