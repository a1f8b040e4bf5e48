#include "floatframe/reduction/part_health.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/model_checks.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/vector_text.hpp"
#include "floatframe/reduction/free_structure.hpp"

namespace floatframe {

MassProperties mass_properties(const SparseMatrix& M, const MatX& R) {
  const Mat6 M_rr = R.transpose() * (M * R);
  MassProperties p;
  p.mass = M_rr.topLeftCorner<3, 3>().trace() / 3.0;
  p.J_origin = 0.5 * (M_rr.bottomRightCorner<3, 3>() + M_rr.bottomRightCorner<3, 3>().transpose());
  // int e_i . (e_k x r) dm
  if (p.mass > 0.0) p.centre = Vec3(M_rr(1, 5), M_rr(2, 3), M_rr(0, 4)) / p.mass;
  return p;
}

MassProperties mass_properties(const InertiaInvariants& invariants) {
  return {invariants.m, invariants.centre_of_mass(), invariants.inertia_about_origin()};
}

void require_mass_and_elasticity(const FeModel& model, const FeSystem& system,
                                 const MassProperties& properties) {
  if (!(properties.mass > 0.0))
    throw InputError(ErrorCode::singular,
                     "the part has no mass: every density is zero, and there is no point mass");
  double rounding = 0.0;  // remainder of springs within a rigid body
  if (model.elements.empty())
    for (const Spring& s : model.springs) rounding = std::max(rounding, 1e-12 * s.stiffness);
  // `check_rigid_motions` rejects values that are not finite.
  const VecX diagonal = system.K.diagonal();
  if ((diagonal.array() <= rounding).all())
    throw InputError(
        ErrorCode::singular,
        "the part has mass but no elasticity: no element or spring resists what its nodes can do");
}

void require_inertia(const FeModel& model, const FeSystem& system, const PartOptions& options,
                     const MassProperties& properties) {
  // In the frame of an interface its supports are enough.
  if (options.method == ModeMethod::craig_bampton &&
      options.reference.kind == BodyReference::Kind::node)
    return;
  const MatX turn = rigid_motions(model, system, properties.centre).rightCols<3>();
  const MatX J = turn.transpose() * (system.M * turn);
  const SymmetricEigen inertia = symmetric_eigen(0.5 * (J + J.transpose()));
  const VecX& J_i = inertia.values;
  if (!J_i.allFinite() || J_i(0) > 1e-12 * J_i(2)) return;
  const bool point = !(J_i(2) > 1e-12 * properties.J_origin.norm()) || J_i(2) == 0.0;
  const Vec3 axis = inertia.vectors.col(0);
  throw InputError(
      ErrorCode::singular,
      point ? "the part has no inertia about its centre of mass, since all mass is at one point; "
              "give point masses their inertia"
            : fmt::format("the part has no inertia about the axis {} through its centre of mass, "
                          "since all mass is on a line; give point masses their inertia, beams "
                          "consistent mass (--mass-form consistent)",
                          vector_text(axis)));
}

namespace {

/// Frequencies that do not occur in machine parts.
constexpr double lowest_usual = 0.01, highest_usual = 2e6;

void warn_of_interfaces(HealthReport& health) {
  for (const InterfaceHealth& h : health.interfaces) {
    if (h.kind == "node") continue;
    if (h.nodes < 6) {
      health.warnings.push_back(
          fmt::format("interface '{}' has only {} nodes; loads enter the part at single points",
                      h.name, h.nodes));
    }
    if (h.condition > 30.0) {
      health.warnings.push_back(
          fmt::format("interface '{}': its nodes lie almost on a line (condition {:.0f}); one "
                      "rotation is hardly held",
                      h.name, h.condition));
    }
  }
  for (const InterfaceHealth& h : health.interfaces) {
    if (h.static_error > 0.01)
      health.warnings.push_back(
          fmt::format("interface '{}' is too stiff in the reduced body: its displacements under "
                      "unit loads are wrong by {:.1f} %",
                      h.name, 100.0 * h.static_error));
  }
}

void warn_of_modes(HealthReport& health) {
  // The modes above the range of interest are never exact: only those covered by the normal modes.
  double range = 0.0;
  for (const ModeHealth& m : health.normal_modes)
    if (m.kept) range = std::max(range, m.frequency);
  for (std::size_t k = 0; k < health.free_frequencies.size(); ++k) {
    const FrequencyPair& pair = health.free_frequencies[k];
    if (pair.full > 0.5 * range && k > 0) break;
    if (std::abs(pair.relative_error()) <= 0.01) continue;
    health.warnings.push_back(
        fmt::format("free mode {} is at {:.5g} Hz instead of {:.5g} Hz in the reduced body "
                    "({:+.1f} %); more normal modes would help",
                    k + 1, pair.reduced, pair.full, 100.0 * pair.relative_error()));
    break;
  }
}

}  // namespace

void add_warnings(const FeModel& model, const PointModel& points, HealthReport& health) {
  std::vector<std::string>& list = health.warnings;
  const std::string units = unit_guess(model, health.from_elements.mass);
  if (!units.empty()) list.push_back(units);
  for (const FrequencyPair& pair : health.free_frequencies) {
    if (pair.reduced >= lowest_usual && pair.reduced <= highest_usual) break;
    list.push_back(fmt::format(
        "the first elastic frequency is {:.3g} Hz, which is unusual for a part; check the units",
        pair.reduced));
    break;
  }
  for (std::string& text : model_warnings(model)) list.push_back(std::move(text));
  if (health.volume > 0.0 && health.from_elements.mass > 0.0) {
    const double off = health.volume_times_density / health.from_elements.mass - 1.0;
    if (std::abs(off) > 1e-3)
      list.push_back(
          fmt::format("volume times density is {:+.2f} % off the assembled mass", 100.0 * off));
  }
  if (points.anisotropy > least_anisotropy)
    list.push_back(
        fmt::format("the mass in the matrices differs between directions by up to {:.2g} of its "
                    "largest entry (rotary inertia of another program): the mass matrix of the "
                    "undeformed body is that of the file, but how its rotary part changes with the "
                    "deformation is unknown, which matters where the body spins",
                    points.anisotropy));
  if (model.matrices && !model.matrices->scalars.empty())
    list.push_back(
        fmt::format("the file has {} amplitudes of modes (scalar points) without shapes: its "
                    "matrices are kept, but how these modes change the inertia is unknown, which "
                    "matters where the body spins",
                    model.matrices->scalars.size()));
  if (health.rigid_residual > 1e-9) {
    list.push_back(
        fmt::format("rigid motions cause forces of {:.1e} of the largest stiffness: a support, a "
                    "spring to ground or a wrong linear equation is in the model",
                    health.rigid_residual));
  }
  if (health.rigid_eigenvalues && health.rigid_eigenvalues->cwiseAbs().maxCoeff() > 1e-6) {
    list.push_back(fmt::format(
        "a rigid motion has an eigenvalue of {:.1e} of the first elastic one instead of zero",
        health.rigid_eigenvalues->cwiseAbs().maxCoeff()));
  }
  warn_of_interfaces(health);
  warn_of_modes(health);
}

}  // namespace floatframe
