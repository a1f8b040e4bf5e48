// From a finite-element part to a flexible body, in stages.
#include "floatframe/reduction/part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "floatframe/body/check_invariants.hpp"
#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/model_checks.hpp"
#include "floatframe/fe/strain_energy.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/reduction/body_reference.hpp"
#include "floatframe/reduction/connectivity.hpp"
#include "floatframe/reduction/matrix_integrals.hpp"
#include "floatframe/reduction/mode_basis.hpp"
#include "floatframe/reduction/part_damping.hpp"
#include "floatframe/reduction/part_health.hpp"
#include "floatframe/reduction/part_second_order.hpp"
#include "floatframe/reduction/part_stress.hpp"
#include "floatframe/reduction/part_turning.hpp"
#include "floatframe/reduction/rigid_check.hpp"
#include "floatframe/reduction/static_check.hpp"

namespace floatframe {
namespace {

/// Free frequencies of the report, at most.
constexpr int free_modes = 20;

class Stages {
 public:
  Stages(const PartOptions& options, HealthReport& health) : options_(options), health_(health) {}
  void done(const std::string& stage) {
    const auto now = std::chrono::steady_clock::now();
    const double seconds = std::chrono::duration<double>(now - last_).count();
    last_ = now;
    health_.seconds.emplace_back(stage, seconds);
    if (options_.progress) options_.progress(stage, seconds);
  }

 private:
  const PartOptions& options_;
  HealthReport& health_;
  std::chrono::steady_clock::time_point last_ = std::chrono::steady_clock::now();
};

/// Columns are given the sign that makes their largest component positive.
void fix_signs(const MatX& X, MatX& C) {
  for (Eigen::Index a = 0; a < C.cols(); ++a) {
    C.col(a) *= sign_of_largest(X * C.col(a));
  }
}

/// Every shape of the basis is scaled to a largest displacement of 1, rotations counted times the
/// size of the part: then masses are distinguished from zero in any units and at any size.
void normalise(const FeSystem& system, double size, ModeBasis& basis) {
  const VecX lengths = row_lengths(system, size);
  VecX factor(basis.X.cols());
  for (Eigen::Index a = 0; a < factor.size(); ++a) {
    const double largest = lengths.cwiseProduct(basis.X.col(a)).cwiseAbs().maxCoeff();
    factor(a) = largest > 0.0 ? 1.0 / largest : 1.0;
  }
  basis.X *= factor.asDiagonal();
  basis.K = (factor.asDiagonal() * basis.K * factor.asDiagonal()).eval();
  basis.rigid = (factor.cwiseInverse().asDiagonal() * basis.rigid).eval();
}

/// Very many beams in a row: are the normal modes accurate?
void check_beams(const FeModel& model, const FeSystem& system, const ModeBasis& basis,
                 Integration integration) {
  const Eigen::Index first = basis.first_normal, count = basis.frequencies.size();
  const bool beams = std::any_of(model.elements.begin(), model.elements.end(),
                                 [](const FeElement& e) { return is_beam(e.type); });
  if (count == 0 || !beams) return;
  const MatX X = basis.X.middleCols(first, count);
  const std::vector<std::string> names(basis.names.begin() + first,
                                       basis.names.begin() + first + count);
  check_digits(model, system.T * X, system.T_theta * X, basis.K.diagonal().segment(first, count),
               names, integration);
}

/// The responses to unit loads needed by the stress stiffness; empty for given matrices.
MatX unit_response(const PlacedPart& part, const PointModel& points, const ModeBasis& basis,
                   const std::optional<FixedInterface>& fixed,
                   const std::optional<FreeStructure>& structure, const Eigenpairs& elastic) {
  if (part.model.matrices) return {};
  const MatX loads = body_loads(points), B = reference_rows(part, loads);
  return fixed ? held_response(part, loads, B, *fixed, basis)
               : free_response(part, loads, B, *structure, elastic);
}

ModalNode interface_node(const FeModel& model, const FeSystem& system, const InterfacePlace& place,
                         const MatX& X) {
  ModalNode node;
  node.name = place.name;
  node.p = model.positions[place.node];
  node.X = system.T.middleRows(3 * place.node, 3) * X;
  node.X_theta = system.T_theta.middleRows(3 * place.node, 3) * X;
  return node;
}

void add_surface(const FeModel& model, const FeSystem& system, const MatX& X, ReducedPart& part) {
  part.surface = outer_surface(model);
  const auto n = static_cast<Eigen::Index>(part.surface.nodes.size());
  const MatX U = system.T * X;
  part.surface_positions.resize(3, n);
  part.surface_modes.resize(3 * n, X.cols());
  for (Eigen::Index k = 0; k < n; ++k) {
    const int node = part.surface.nodes[k];
    part.surface_positions.col(k) = model.positions[node];
    part.surface_modes.middleRows<3>(3 * k) = U.middleRows<3>(3 * node);
  }
}

/// Written data must be readable.
void check_body(const FlexibleBody& body, bool rotary) {
  ErrorList errors;
  for (const InvariantError& f :
       check_invariants(body, rotary ? InvariantSource::rotary : InvariantSource::integrals))
    errors.add(
        ErrorCode::singular, {},
        fmt::format("the reduced part has no valid inertia: {}: {}", f.quantity, f.sentence));
  errors.throw_if_any();
}

void free_frequencies(const FeModel& model, const VecX& reduced, const Eigenpairs* full,
                      HealthReport& health) {
  const Eigen::Index count =
      full ? full->lambda.size() - 6 : std::min<Eigen::Index>(reduced.size(), free_modes);
  for (Eigen::Index k = 0; k < std::min(count, reduced.size()); ++k) {
    FrequencyPair pair;
    pair.reduced = hertz_of_eigenvalue(reduced(k));
    if (full) pair.full = hertz_of_eigenvalue(full->lambda(k + 6));
    health.free_frequencies.push_back(pair);
  }
  if (!full || full->lambda.size() <= 6) return;
  health.rigid_eigenvalues = full->lambda.head<6>() / full->lambda(6);
  const double worst = health.rigid_eigenvalues->cwiseAbs().maxCoeff();
  if (worst > 1e-3)
    throw InputError(ErrorCode::contradiction,
                     fmt::format("a rigid motion has an eigenvalue of {:.1e} of the first elastic "
                                 "one instead of zero: {}",
                                 worst, stiffness_cause_text(model, health.rigid_residual)));
}

/// Mass of the model, and whether its stiffness allows rigid motions.
void check_model(const PlacedPart& part, HealthReport& health) {
  const FeModel& model = part.model;
  const FeSystem& system = part.system;
  health.dofs = system.size();
  health.from_elements = mass_properties(system.M, part.R);
  require_mass_and_elasticity(model, system, health.from_elements);
  require_inertia(model, system, part.options, health.from_elements);
  health.rigid_residual = check_rigid_motions(model, system);
  health.volume = volume(model);
  health.volume_times_density = volume_times_density(model);
}

/// The body of the modes `modes` of `basis` in its frame; `X` its shapes at all degrees of freedom.
FlexibleBody body_of(const PlacedPart& part, const ModeBasis& basis, const InertiaInvariants& raw,
                     const ElasticModes& modes, const MatX& X) {
  ModeSet set{X, modes.lambda.asDiagonal(), basis.frequencies, {}};
  for (Eigen::Index a = 0; a < X.cols(); ++a) set.names.push_back(fmt::format("elastic {}", a + 1));
  set.equal_left_out = basis.equal_left_out;
  FlexibleBody body = body_of_modes(std::move(set), combined(raw, modes.C));
  for (const InterfacePlace& place : part.interfaces)
    body.nodes.push_back(interface_node(part.model, part.system, place, X));
  body.interfaces = mounted_at(part.interfaces);
  for (const MarkerPlace& marker : part.markers)
    body.nodes.push_back({marker.name, marker.p, marker.translation * X, marker.rotation * X});
  return body;
}

/// `response`: empty for given matrices.
void add_second_order(const PlacedPart& part, const PointModel& points, const MatX& X,
                      const MatX& response, FlexibleBody& body) {
  PartSecondOrder second_order;
  if (response.size() > 0) second_order = part_second_order(part, points, X, response);
  body.second_order = second_order.stiffening;
  body.turning = part_turning(points, X, second_order.twist);
  if (part.options.keep_projection) body.projection = projection_of(points, X, second_order.twist);
}

/// In the mean-axis frame: those of the free body.
ElasticModes free_elastic_modes(const FeModel& model, const FeSystem& system,
                                const ModeBasis& basis, const InertiaInvariants& raw) {
  ElasticModes free = elastic_modes(basis.K, raw, momentum_of_modes(raw));
  if (free.lambda.size() > 0 && !(free.stiffness > least_stiffness))
    throw InputError(ErrorCode::singular, mechanism_text(model, system, basis.X * free.C.col(0)));
  return free;
}

/// In the requested frame.
ElasticModes body_modes(const PlacedPart& part, const ModeBasis& basis,
                        const InertiaInvariants& raw, HealthReport& health) {
  ElasticModes modes = elastic_modes(basis.K, raw, reference_conditions(part, basis, raw));
  if (modes.mass < least_modal_mass)
    throw InputError(ErrorCode::singular,
                     "a combination of the modes moves as a rigid body and has no inertia of its "
                     "own; use fewer modes or a finer mesh");
  fix_signs(basis.X, modes.C);
  health.modal_mass_condition = modes.condition;
  if (modes.without_mass > 0)
    health.notes.push_back(
        fmt::format("of the modes {} combined motions move no mass and are left out: there are "
                    "more interface degrees of freedom and modes than the mesh has ways to move",
                    modes.without_mass));
  return modes;
}

/// Modes of the free part: of the model in addition to those of the body on request. `structure`:
/// if its factors exist already. At least one mode is computed, to detect supports of the part.
void check_free_modes(const PlacedPart& part, const VecX& reduced, Eigen::Index fixed_modes,
                      std::optional<FreeStructure>& structure, HealthReport& health) {
  const FeModel& model = part.model;
  const FeSystem& system = part.system;
  const PartOptions& options = part.options;
  if (!options.check_free_modes) return free_frequencies(model, reduced, nullptr, health);
  if (!structure) {
    const double first = reduced.size() > 0 ? reduced(0) : elastic_estimate(model, system);
    structure.emplace(system.K, system.M, part.R, 0.3 * first, options.solver,
                      [&](int row) { return row_label(model, system, row); });
  }
  const Eigen::Index most = std::clamp<Eigen::Index>(fixed_modes, 10, free_modes);
  const auto count = static_cast<int>(std::clamp<Eigen::Index>(reduced.size(), 1, most));
  const Eigenpairs full = structure->modes(std::min(6 + count, system.size()));
  if (full.shapes.cols() > 6)
    check_stiffness_of(model, system, full.shapes.rightCols(full.shapes.cols() - 6));
  free_frequencies(model, reduced, &full, health);
}

}  // namespace

ReducedPart reduce_part(FeModel model, const PartOptions& options) {
  ReducedPart out;
  HealthReport& health = out.health;
  Stages stages(options, health);
  check_options(options);
  validate(model);
  health.nodes = model.places();
  health.elements = static_cast<int>(model.elements.size());
  std::vector<MarkerPlace> markers = place_markers(model, options);
  std::vector<InterfacePlace> interfaces = place_interfaces(model, options, markers);
  health.notes = model.notes;
  check_connected(model);
  stages.done("model");

  const FeSystem system = assemble(model, options.integration);
  const PointModel points = point_model(model, system, options.integration);
  find_rows(model, system, interfaces);
  find_motions(model, system, markers);
  const MatX R = rigid_motions(model, system, Vec3::Zero());
  const PlacedPart part{model, system, R, interfaces, markers, options};
  check_model(part, health);
  stages.done("assembly");

  std::optional<FixedInterface> fixed;
  std::optional<FreeStructure> structure;
  Eigenpairs elastic;
  const bool held = options.method == ModeMethod::craig_bampton;
  ModeBasis basis = held ? craig_bampton_basis(part, fixed) : free_basis(part, structure, elastic);
  report_basis(basis, health);
  const Statics statics = statics_of(basis, structure, elastic, interfaces, system.size());
  stages.done("modes");
  const MatX response = unit_response(part, points, basis, fixed, structure, elastic);
  const bool stresses = options.stresses && !model.matrices;
  if (!stresses) fixed.reset();  // the factors are the largest piece of memory
  stages.done("unit loads");
  check_stiffness_of(model, system, elastic.shapes);
  check_beams(model, system, basis, options.integration);
  normalise(system, part_size(model, system), basis);

  InertiaInvariants raw = invariants_points(points.p, points.M_s, points.T * basis.X);
  if (model.matrices) match_mass_matrix(system, R, basis.X, raw);
  const ElasticModes free = free_elastic_modes(model, system, basis, raw);
  const ElasticModes modes = body_modes(part, basis, raw, health);
  const MatX X = basis.X * modes.C;
  out.body = body_of(part, basis, raw, modes, X);
  add_damping(part, X, out.body, health);
  health.modes = out.body.modes();
  health.from_invariants = mass_properties(out.body.invariants);
  health.rotary_inertia = points.rotary || points.anisotropy > least_anisotropy;
  check_body(out.body, *health.rotary_inertia);
  stages.done("body");
  add_surface(model, system, X, out);
  stages.done("surface");
  if (stresses && X.cols() > 0) {
    MatX loads =
        body_load_response(model, system, X, fixed, structure, elastic, options.integration);
    fixed.reset();
    out.body.stress =
        part_stress(model, system, out.surface.nodes, X, out.body.K, std::move(loads));
    stages.done("stress");
  }
  if (X.cols() > 0) {
    add_second_order(part, points, X, response, out.body);
    stages.done("stress stiffness");
  } else if (options.keep_projection) {
    out.body.projection = projection_of(points, X, {});
  }

  for (const InterfacePlace& place : interfaces) health.interfaces.push_back(place.health);
  check_statics(interfaces, out.body, statics.stiffness, statics.flexibility, health);
  check_free_modes(part, free.lambda, basis.frequencies.size(), structure, health);
  if (options.check_free_modes) stages.done("free modes of the full model");
  add_warnings(model, points, health);
  return out;
}

}  // namespace floatframe
