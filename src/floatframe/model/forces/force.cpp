// Applied force on b: direction x (magnitude(t) + input). A direction that follows the body rotates
// with it: dF = dpi_b x F, so -dF/dpi_b = skew(F). A fixed one has no tangent.
#include "floatframe/model/force_kind.hpp"

namespace floatframe {

template <>
void force_of<ForceType::force>(const ForceInput& in, ForceState& out) noexcept {
  out.force = in.magnitude();
  out.wrench.Fb = in.load(out.force);
}

template <>
void force_tangent_of<ForceType::force>(const ForceInput& in, ForceTangent& out) noexcept {
  if (in.force.follows)
    out.K.block<3, 3>(part_of::r_b, part_of::pi_b) = skew(in.load(in.magnitude()));
}

namespace {

constexpr auto keys_of_force = load_keys(ForceAxis::along);

bool force_build(ForceBuild& b) { return b.load(b.flag("follows")); }

constexpr ForceRegime force_regimes[] = {{.name = "fixed", .conservative = false},
                                         {.name = "following",
                                          .rows_leave_out = "the turning of the load with its body",
                                          .conservative = false}};

ForceExample force_example(std::size_t regime, ExampleNumbers& numbers) {
  return example_load(ForceType::force, regime == 1, numbers);
}

}  // namespace

constinit const ForceKind force_element = {
    .about = "force on a point of a body",
    .keys = keys_of_force,
    .markers = ForceMarkers::one,
    .energy = EnergyCategory::loads,
    .measured = false,
    .blank = [] { return ForceDescription::Values(AppliedLoadDescription()); },
    .build = force_build,
    .regimes = force_regimes,
    .example = force_example};

}  // namespace floatframe
