#include "floatframe/reduction/part_reference.hpp"

#include <algorithm>

#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/reduction/part_second_order.hpp"

namespace floatframe {
namespace {

/// Points of the model with unit density and without point masses: integrals over the volume.
PointModel volume_points(FeModel model, Integration integration) {
  if (model.matrices) {
    throw InputError(ErrorCode::unsupported,
                     "the Buckens reference weighs by volume, which a part given by matrices does "
                     "not have; take mean_axis");
  }
  for (Material& m : model.materials) m.density = 1.0;
  for (ShellSection& s : model.shells) s.mass = 0.0;
  for (PointMass& m : model.masses) {  // its degrees of freedom stay
    m.mass = 0.0;
    m.J *= 1e-100;
  }
  return point_model(model, assemble(model, integration), integration);
}

/// Uniform density without point masses: the volume weighs as the mass does.
bool uniform(const FeModel& model) {
  if (!model.masses.empty() || model.matrices || model.materials.empty()) return false;
  if (std::any_of(model.shells.begin(), model.shells.end(),
                  [](const ShellSection& s) { return s.mass != 0.0; }))
    return false;
  const double density = model.materials.front().density;
  return std::all_of(model.materials.begin(), model.materials.end(),
                     [&](const Material& m) { return m.density == density; });
}

}  // namespace

MatX reference_conditions(const FeModel& model, const ModeBasis& basis,
                          const InertiaInvariants& raw,
                          const std::vector<InterfacePlace>& interfaces,
                          const PartOptions& options) {
  switch (options.reference.kind) {
    case BodyReference::Kind::mean_axis:
      break;
    case BodyReference::Kind::buckens:
      if (!uniform(model)) {
        const PointModel points = volume_points(model, options.integration);
        return momentum_of_modes(invariants_points(points.p, points.M_s, points.T * basis.X));
      }
      break;
    case BodyReference::Kind::node:
      for (const InterfacePlace& place : interfaces) {
        if (place.name != options.reference.node) continue;
        MatX B(6, basis.X.cols());
        for (Eigen::Index i = 0; i < 6; ++i) B.row(i) = basis.X.row(place.rows[i]);
        return B;
      }
      break;
  }
  return momentum_of_modes(raw);
}

MatX reference_rows(const FeModel& model, const MatX& loads,
                    const std::vector<InterfacePlace>& interfaces, const PartOptions& options) {
  if (options.reference.kind == BodyReference::Kind::buckens && !uniform(model))
    return momentum_rows(body_loads(volume_points(model, options.integration)));
  for (const InterfacePlace& place : interfaces) {
    if (options.reference.kind != BodyReference::Kind::node) break;
    if (place.name != options.reference.node) continue;
    MatX B = MatX::Zero(6, loads.rows());
    for (Eigen::Index i = 0; i < 6; ++i) B(i, place.rows[i]) = 1.0;
    return B;
  }
  return momentum_rows(loads);
}

}  // namespace floatframe
