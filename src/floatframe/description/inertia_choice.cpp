#include "floatframe/description/inertia_choice.hpp"

namespace floatframe {

void check_inertia_method(const ModelDescription& description, InertiaMethod method) {
  ErrorList errors;
  for (const BodyDescription& b : description.bodies) {
    if (b.rigid) continue;
    const bool own = b.geometric_stiffening.has_value();
    const auto* part = std::get_if<FlexibleBody>(&b.kind);
    if (method == InertiaMethod::projection && part && part->projection &&
        part->projection->h.size() == 0 &&
        b.geometric_stiffening.value_or(
            description.simulation.geometric_stiffening.value_or(false)))
      errors.add(ErrorCode::unsupported,
                 own ? b.origin.of("geometric_stiffening")
                     : description.simulation.origin.of("geometric_stiffening"),
                 "bodies." + b.name +
                     ".geometric_stiffening: found true of a part with inertia terms by "
                     "projection, expected preprocessing (or false)");
    if (part && part->modes() > 0 && !part->projection && method == InertiaMethod::projection)
      errors.add(ErrorCode::unsupported,
                 b.origin.of(b.origin.keys.contains("part") ? "part" : "flexible"),
                 "bodies." + b.name +
                     ": the part was reduced without projection data, expected inertia terms by "
                     "preprocessing (or a reduction with projection: true)");
    const auto* flexible = std::get_if<FlexibleDescription>(&b.kind);
    if (!flexible) continue;
    const SourceMark& mark = b.origin.of("mass_model");
    const std::string who = "bodies." + b.name + ".flexible.mass_model: found ";
    if (method == InertiaMethod::projection && flexible->mass_model == MassModel::hermite)
      errors.add(ErrorCode::unsupported, mark,
                 who +
                     "hermite with inertia terms by projection, expected isoparametric or six_dof "
                     "(or preprocessing)");
    if (method == InertiaMethod::preprocessing && flexible->mass_model == MassModel::six_dof)
      errors.add(ErrorCode::unsupported, mark,
                 who +
                     "six_dof with inertia terms by preprocessing, expected isoparametric or "
                     "hermite (or projection)");
  }
  errors.throw_if_any();
}

}  // namespace floatframe
