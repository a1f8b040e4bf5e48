#include "floatframe/reduction/mode_basis.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/fe/strain_energy.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/reduction/connectivity.hpp"
#include "floatframe/reduction/mode_selection.hpp"
#include "floatframe/reduction/rigid_check.hpp"

namespace floatframe {
namespace {

MatX forces_of(const std::vector<MarkerPlace>& markers, int n, std::vector<std::string>& names) {
  std::vector<const MarkerPlace*> loaded;
  for (const MarkerPlace& m : markers)
    if (m.residual) loaded.push_back(&m);
  MatX F(n, 3 * static_cast<Eigen::Index>(loaded.size()));
  for (std::size_t k = 0; k < loaded.size(); ++k) {
    F.middleCols<3>(3 * static_cast<Eigen::Index>(k)) =
        MatX(SparseMatrix(loaded[k]->translation.transpose()));
    for (int axis = 0; axis < 3; ++axis)
      names.push_back("attachment " + loaded[k]->name + " " + node_dof_names[axis]);
  }
  return F;
}

/// Independent directions of attachment modes: X with X^T K X = I among them. `full`: the energies
/// 1/2 f u before the component of other modes was removed.
MatX independent(const MatX& X, const MatX& energy, const VecX& full,
                 std::vector<std::string>& names) {
  std::vector<Eigen::Index> kept;
  for (Eigen::Index a = 0; a < X.cols(); ++a)
    if (energy(a, a) > 1e-8 * std::max(full(a), full.maxCoeff() * 1e-8)) kept.push_back(a);
  if (kept.empty()) {
    names.clear();
    return MatX::Zero(X.rows(), 0);
  }
  const auto n = static_cast<Eigen::Index>(kept.size());
  MatX Y(X.rows(), n), E(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index a = kept[i];
    Y.col(i) = X.col(a) / std::sqrt(energy(a, a));
    for (Eigen::Index j = 0; j < n; ++j) {
      const Eigen::Index b = kept[j];
      E(i, j) = 0.5 * (energy(a, b) + energy(b, a)) / std::sqrt(energy(a, a) * energy(b, b));
    }
  }
  const SymmetricEigen eigen = symmetric_eigen(E);
  Eigen::Index first = 0;
  while (first < n && !(eigen.values(first) > 1e-8)) ++first;
  names.clear();
  for (Eigen::Index a = first; a < n; ++a)
    names.push_back(fmt::format("attachment {}", a - first + 1));
  return Y * eigen.vectors.rightCols(n - first) *
         eigen.values.tail(n - first).cwiseSqrt().cwiseInverse().asDiagonal();
}

void append_modes(ModeBasis& basis, const MatX& X, const MatX& K,
                  const std::vector<std::string>& names) {
  const Eigen::Index old = basis.X.cols(), added = X.cols();
  basis.X.conservativeResize(X.rows(), old + added);
  basis.X.rightCols(added) = X;
  MatX all = MatX::Zero(old + added, old + added);
  all.topLeftCorner(old, old) = basis.K;
  all.bottomRightCorner(added, added) = K;
  basis.K = all;
  basis.names.insert(basis.names.end(), names.begin(), names.end());
}

}  // namespace

void check_options(const PartOptions& options) {
  ErrorList errors;
  const auto add = [&](ErrorCode code, std::string text) { errors.add(code, {}, std::move(text)); };
  const bool free = options.method != ModeMethod::craig_bampton;
  if (options.modes && *options.modes < 0)
    add(ErrorCode::out_of_range, "the number of normal modes must not be negative");
  if (!(options.max_frequency >= 0.0) || !std::isfinite(options.max_frequency))
    add(ErrorCode::out_of_range, "the highest frequency must be positive");
  if (!(options.effective_mass >= 0.0 && options.effective_mass <= 1.0))
    add(ErrorCode::out_of_range,
        "the effective mass to be reached must be a fraction between 0 and 1");
  if (free && options.effective_mass > 0.0)
    add(ErrorCode::unsupported,
        "free modes have no effective mass; select them by number or by frequency");
  if (const auto complaint = damping_complaint(options.damping))
    add(ErrorCode::out_of_range, "damping: " + *complaint);
  if (options.interfaces.empty() && options.method == ModeMethod::craig_bampton)
    add(ErrorCode::incomplete,
        "the Craig-Bampton method needs an interface; give one, or take free_free");
  if (options.interfaces.empty() && options.method == ModeMethod::craig_chang)
    add(ErrorCode::incomplete,
        "the Craig-Chang method needs an interface; give one, or take free_free");
  if (options.reference.kind == BodyReference::Kind::node) {
    const auto it = std::find_if(
        options.interfaces.begin(), options.interfaces.end(),
        [&](const InterfaceDescription& d) { return d.name == options.reference.node; });
    if (it == options.interfaces.end()) {
      std::string list;
      for (const InterfaceDescription& d : options.interfaces)
        list += (list.empty() ? "'" : ", '") + d.name + "'";
      add(ErrorCode::not_found,
          fmt::format("the body reference is the interface '{}', which does not exist; there {}",
                      options.reference.node, list.empty() ? "are none" : "are " + list));
    } else if ((it->mask & 63u) != 63u) {
      add(ErrorCode::incomplete,
          fmt::format("the body reference needs all six degrees of freedom of the interface '{}'",
                      it->name));
    }
  }
  errors.throw_if_any();
}

void report_basis(const ModeBasis& basis, HealthReport& health) {
  health.solver = basis.solver;
  health.normal_modes = basis.modes;
  if (const auto cut = cut_pair(basis.frequencies, basis.equal_left_out))
    health.notes.push_back(
        cut_pair_text(*cut, "modes") +
        " (a round part would bend more easily in one direction than in another)");
}

ModeBasis craig_bampton_basis(const PlacedPart& part, std::optional<FixedInterface>& fixed) {
  const FeModel& model = part.model;
  const FeSystem& system = part.system;
  const MatX& R = part.R;
  const std::vector<InterfacePlace>& interfaces = part.interfaces;
  const std::vector<MarkerPlace>& markers = part.markers;
  const PartOptions& options = part.options;
  std::vector<int> boundary;
  std::vector<std::string> names;
  for (const InterfacePlace& place : interfaces) {
    boundary.insert(boundary.end(), place.rows.begin(), place.rows.end());
    for (const int axis : place.axes)
      names.push_back("static " + place.name + " " + node_dof_names[axis]);
  }
  with_digits_hint(model, [&] {
    fixed.emplace(
        system.K, system.M, boundary, std::vector<int>{},
        [&](int row) { return row_label(model, system, row); }, options.solver);
  });
  ModeBasis basis;
  basis.solver = fixed->solver_name();
  int equal_left_out = 0;
  const Eigenmodes normal = select_fixed_modes(*fixed, part, boundary, basis.modes, equal_left_out);
  static_cast<ModeSet&>(basis) = craig_bampton_set(*fixed, normal, names);
  basis.equal_left_out = equal_left_out;
  const auto nb = static_cast<Eigen::Index>(boundary.size());
  basis.first_normal = static_cast<int>(nb);

  names.clear();
  const MatX F = forces_of(markers, system.size(), names);
  if (F.cols() > 0) {
    MatX Y = fixed->inner_response(F);
    const VecX full = (F.transpose() * Y).diagonal();
    const VecX weight = normal.omega.cwiseAbs2().cwiseInverse();
    Y -= normal.shapes * weight.asDiagonal() * (normal.shapes.transpose() * F);
    // (F - M x x^T F)^T Y = F^T Y: the remainder is orthogonal to the normal modes.
    const MatX added = independent(Y, F.transpose() * Y, full, names);
    append_modes(basis, added, MatX::Identity(added.cols(), added.cols()), names);
  }
  basis.rigid = MatX::Zero(basis.X.cols(), 6);
  for (Eigen::Index b = 0; b < nb; ++b) basis.rigid.row(b) = R.row(boundary[b]);
  return basis;
}

ModeBasis free_basis(const PlacedPart& part, std::optional<FreeStructure>& structure,
                     Eigenpairs& elastic) {
  const FeModel& model = part.model;
  const FeSystem& system = part.system;
  const MatX& R = part.R;
  const std::vector<InterfacePlace>& interfaces = part.interfaces;
  const std::vector<MarkerPlace>& markers = part.markers;
  const PartOptions& options = part.options;
  VecX softest;
  const double estimate = elastic_estimate(model, system, &softest);
  ModeBasis basis;
  with_digits_hint(model, [&] {
    try {
      structure.emplace(system.K, system.M, R, 0.01 * estimate, options.solver,
                        [&](int row) { return row_label(model, system, row); });
    } catch (const InputError&) {
      // With very few elements a mechanism moves as simply as the shapes of the estimate.
      if (softest.size() > 0) check_stiffness_of(model, system, softest);
      throw;
    }
    elastic = select_free_modes(*structure, part, basis.modes, basis.equal_left_out);
  });
  basis.solver = structure->solver_name();
  const Eigen::Index count = elastic.lambda.size();
  basis.X.resize(system.size(), 6 + count);
  basis.X.leftCols<6>() = R;
  basis.X.rightCols(count) = elastic.shapes;
  basis.K = MatX::Zero(6 + count, 6 + count);
  basis.K.diagonal().tail(count) = elastic.lambda;
  basis.first_normal = 6;
  basis.frequencies = elastic.lambda.cwiseSqrt().unaryExpr(&hertz);
  for (const char* axis : node_dof_names) basis.names.push_back(std::string("rigid ") + axis);
  for (const ModeHealth& m : basis.modes) basis.names.push_back(m.name);

  std::vector<std::string> names;
  MatX F = forces_of(markers, system.size(), names);
  if (options.method == ModeMethod::craig_chang) {
    for (const InterfacePlace& place : interfaces) {
      const Eigen::Index old = F.cols();
      F.conservativeResize(system.size(), old + static_cast<Eigen::Index>(place.rows.size()));
      F.rightCols(static_cast<Eigen::Index>(place.rows.size())).setZero();
      for (std::size_t k = 0; k < place.rows.size(); ++k)
        F(place.rows[k], old + static_cast<Eigen::Index>(k)) = 1.0;
    }
  }
  if (F.cols() > 0) {
    MatX Y = structure->relieved_response(F, elastic);
    const VecX full = (F.transpose() * Y).diagonal();
    Y -= elastic.shapes * elastic.lambda.cwiseInverse().asDiagonal() *
         (elastic.shapes.transpose() * F);
    const MatX added = independent(Y, F.transpose() * Y, full, names);
    append_modes(basis, added, MatX::Identity(added.cols(), added.cols()), names);
  }
  basis.rigid = MatX::Zero(basis.X.cols(), 6);
  basis.rigid.topRows<6>().setIdentity();
  return basis;
}

}  // namespace floatframe
