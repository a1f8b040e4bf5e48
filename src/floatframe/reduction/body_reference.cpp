#include "floatframe/reduction/body_reference.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/body/fe_invariants.hpp"
#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/reduction/part_second_order.hpp"

namespace floatframe {
namespace {

constexpr double no_mass = 1e-13;  ///< of the largest eigenvalue

/// A in the directions C, symmetric except for round-off.
MatX in_directions(const MatX& A, const MatX& C) {
  const MatX a = C.transpose() * A * C;
  return 0.5 * (a + a.transpose());
}

/// The combinations of the directions C that have mass, as modes: M x = K x / w^2, so that those
/// without are at w^-2 = 0. All of C if it holds a mechanism.
MatX with_mass(const MatX& C, const MatX& K, const MatX& M) {
  const SymmetricEigen eig = generalised_eigen(in_directions(M, C), in_directions(K, C));
  const double most = eig.values(eig.values.size() - 1);  // of w^-2, ascending
  if (!eig.found || !(most > 0.0)) return C;
  return C * eig.vectors.rightCols((eig.values.array() > no_mass * most).count());
}

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

/// Uniform density without point masses: volume and mass weights are equal.
bool uniform(const FeModel& model) {
  if (!model.masses.empty() || model.matrices || model.materials.empty()) return false;
  if (std::any_of(model.shells.begin(), model.shells.end(),
                  [](const ShellSection& s) { return s.mass != 0.0; }))
    return false;
  const double density = model.materials.front().density;
  return std::all_of(model.materials.begin(), model.materials.end(),
                     [&](const Material& m) { return m.density == density; });
}

/// The interface that the body frame follows; null: none.
const InterfacePlace* reference_node(const PlacedPart& part) {
  const BodyReference& reference = part.options.reference;
  if (reference.kind != BodyReference::Kind::node) return nullptr;
  const auto named = [&](const InterfacePlace& place) { return place.name == reference.node; };
  const auto it = std::find_if(part.interfaces.begin(), part.interfaces.end(), named);
  return it == part.interfaces.end() ? nullptr : &*it;
}

}  // namespace

ElasticModes elastic_modes(const MatX& K, const InertiaInvariants& raw, const MatX& B) {
  const Eigen::Index n = K.rows();
  ElasticModes result;
  if (n <= 6) {
    result.C = MatX::Zero(n, 0);
    return result;
  }
  const MatX M = modal_mass(raw);
  // Amplitudes of unit kinetic energy; of directions without mass, of unit elastic energy.
  VecX s(n);
  const double top = M.diagonal().maxCoeff();
  for (Eigen::Index a = 0; a < n; ++a) {
    const double size = M(a, a) > 1e-14 * top ? M(a, a) : K(a, a);
    s(a) = size > 0.0 ? 1.0 / std::sqrt(size) : 1.0;
  }
  MatX conditions = B * s.asDiagonal();
  for (Eigen::Index i = 0; i < 6; ++i) {
    const double norm = conditions.row(i).norm();
    if (norm > 0.0) conditions.row(i) /= norm;
  }
  const PivotedQr qr = pivoted_qr(conditions.transpose());
  if (qr.rank < 6)
    throw InputError(ErrorCode::singular,
                     "the body reference does not remove all rigid motions of the part");
  MatX null = s.asDiagonal() * qr.Q.rightCols(n - 6);
  const auto masses = [&] { return symmetric_eigenvalues(in_directions(M, null)); };
  VecX m = masses();
  if (!(m(0) > no_mass * m(m.size() - 1))) {
    null = with_mass(null, K, M);
    result.without_mass = static_cast<int>(n - 6 - null.cols());
    m = masses();
  }
  result.condition = m(0) > 0.0 ? m(m.size() - 1) / m(0) : std::numeric_limits<double>::infinity();
  if (!(m(0) > no_mass * m(m.size() - 1))) {
    throw InputError(
        ErrorCode::singular,
        "the modes hold a combination that moves no mass: there are more interface degrees of "
        "freedom and modes than the mesh has ways to move; use fewer, or a finer mesh");
  }
  const SymmetricEigen modes = generalised_eigen(in_directions(K, null), in_directions(M, null));
  result.lambda = modes.values;
  result.C = null * modes.vectors;
  const VecX first = result.C.col(0).cwiseAbs();
  result.stiffness = result.lambda(0) / first.dot(K.cwiseAbs() * first);
  result.mass = relative_modal_mass(combined(raw, result.C), Mat6X::Identity(6, 6));
  return result;
}

MatX reference_conditions(const PlacedPart& part, const ModeBasis& basis,
                          const InertiaInvariants& raw) {
  const BodyReference& reference = part.options.reference;
  if (reference.kind == BodyReference::Kind::buckens && !uniform(part.model)) {
    const PointModel points = volume_points(part.model, part.options.integration);
    return momentum_of_modes(invariants_points(points.p, points.M_s, points.T * basis.X));
  }
  if (const InterfacePlace* place = reference_node(part)) return basis.X(place->rows, Eigen::all);
  return momentum_of_modes(raw);
}

MatX reference_rows(const PlacedPart& part, const MatX& loads) {
  if (part.options.reference.kind == BodyReference::Kind::buckens && !uniform(part.model))
    return momentum_rows(body_loads(volume_points(part.model, part.options.integration)));
  const InterfacePlace* place = reference_node(part);
  if (!place) return momentum_rows(loads);
  MatX B = MatX::Zero(6, loads.rows());
  for (Eigen::Index i = 0; i < 6; ++i) B(i, place->rows[i]) = 1.0;
  return B;
}

}  // namespace floatframe
