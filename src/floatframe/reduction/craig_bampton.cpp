// Choice of dofs, check of the body reference, constraint modes and fixed-interface modes.
#include <algorithm>
#include <cmath>
#include <optional>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/fe/strain_energy.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/rigid_motion.hpp"
#include "floatframe/math/vector_text.hpp"
#include "floatframe/reduction/bar_chains.hpp"
#include "floatframe/reduction/fixed_interface.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe {
namespace {

enum class Role : char { inner, clamped, interface, inactive };

/// A direction without its round-off.
std::string direction_text(const Vec3& v) {
  return vector_text(v.unaryExpr([](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; }), 3);
}

int node_of(const FeModel& model, const NodeDofs& selection, const char* what, ErrorList& errors) {
  const int node = selection.node.empty() ? selection.index : model.find_node(selection.node);
  if (node < 0 || node >= model.nodes()) {
    errors.add(ErrorCode::not_found, {},
               std::string(what) + ": there is no node " +
                   (selection.node.empty() ? std::to_string(selection.index)
                                           : "'" + selection.node + "'"));
    return -1;
  }
  return node;
}

/// Throws if the clamped dofs leave a rigid motion, with a description of it.
void check_reference(const FeModel& model, const std::vector<Role>& roles, int d) {
  Vec3 centre = Vec3::Zero();
  int count = 0;
  int node = -1;
  double size = 0.0;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] != Role::clamped) continue;
    const int k = static_cast<int>(i) / d;
    if (node < 0) node = k, centre = model.positions[k];
    ++count;
  }
  if (count == 0) {
    throw InputError(
        ErrorCode::singular,
        "the body reference clamps no degree of freedom, so the body is free to move rigidly");
  }
  for (const Vec3& p : model.positions) size = std::max(size, (p - centre).norm());
  MatX R(count, 6);
  int row = 0;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    if (roles[i] != Role::clamped) continue;
    const int axis = static_cast<int>(i) % d;
    const Vec3 p = (model.positions[i / d] - centre) / size;
    R.row(row++) = rigid_motion_at(p).row(axis);
  }
  const Singular svd = singular_values(R);
  const VecX& s = svd.values;
  if (s.size() == 6 && s(5) > 1e-8 * s(0)) return;
  Vec6 motion = svd.V.col(5);
  Eigen::Index largest = 0;
  motion.cwiseAbs().maxCoeff(&largest);
  if (motion(largest) < 0.0) motion = -motion;
  const Vec3 turn = motion.tail<3>();
  if (turn.norm() < 1e-6) {
    throw InputError(ErrorCode::singular,
                     "the body reference does not remove the translation along " +
                         direction_text(motion.head<3>().normalized()));
  }
  throw InputError(ErrorCode::singular,
                   "the body reference does not remove the rotation about the direction " +
                       direction_text(turn.normalized()) + " (clamped: " + model.node_label(node) +
                       (count > 1 ? " and others)" : ")"));
}

SparseMatrix eigen_mass(const FeModel& model, const ReductionOptions& options) {
  const int d = model.dofs_per_node();
  if (options.eigen_mass.value_or(options.mass_model) != MassModel::isoparametric) {
    return assemble_mass(model, options.section_inertia, d);
  }
  const SparseRows scalar = assemble_scalar_mass(model);
  std::vector<Eigen::Triplet<double>> triplets;
  for (int k = 0; k < scalar.outerSize(); ++k) {
    for (SparseRows::InnerIterator it(scalar, k); it; ++it) {
      for (int i = 0; i < 3; ++i) {
        triplets.emplace_back(static_cast<int>(it.row()) * d + i,
                              static_cast<int>(it.col()) * d + i, it.value());
      }
    }
  }
  SparseMatrix M(d * model.nodes(), d * model.nodes());
  M.setFromTriplets(triplets.begin(), triplets.end());
  return M;
}

/// Static modes, then normal modes and residual shapes.
template <class Fixed>
ModeSet mode_set(const Fixed& fixed, const ReductionOptions& options, const SparseMatrix& K,
                 const std::vector<int>& loaded, std::vector<std::string> names) {
  std::optional<int> number;
  if (options.normal_modes != 0 || !(options.max_frequency > 0.0)) number = options.normal_modes;
  const int count = normal_mode_count(fixed, number, options.max_frequency);
  Eigenmodes normal = fixed.normal_modes(count);
  const int found = static_cast<int>(normal.omega.size());
  const int whole =
      found > 0 ? count_with_group(fixed, found, hertz(normal.omega[found - 1])) : found;
  // A frequency limit keeps pairs whole, a given number is exact.
  if (!number && whole > found) normal = fixed.normal_modes(whole);
  ModeSet set = craig_bampton_set(fixed, normal, std::move(names));
  if (number) set.equal_left_out = whole - found;
  append_residual_shapes(fixed, K, normal, loaded, set);
  return set;
}

ModeSet held_modes(const FeModel& model, const ReductionOptions& options, const SparseMatrix& K,
                   const SparseMatrix& M, const std::vector<int>& interface_dofs,
                   const std::vector<int>& zero, const std::vector<int>& loaded,
                   std::vector<std::string> names) {
  const int d = model.dofs_per_node();
  const auto label = [&](int dof) {
    return model.node_label(dof / d) + " " + node_dof_names[dof % d];
  };
  try {
    if (const auto chains = BarChains::make(model, K, M, interface_dofs, zero, label))
      return mode_set(*chains, options, K, loaded, std::move(names));
    std::optional<FixedInterface> fixed;
    with_digits_hint(model, [&] { fixed.emplace(K, M, interface_dofs, zero, label); });
    return mode_set(*fixed, options, K, loaded, std::move(names));
  } catch (const EigenIterationError& error) {
    if (options.section_inertia || options.mass_model == MassModel::isoparametric) throw;
    throw InputError(
        ErrorCode::out_of_range,
        std::string(error.what()) +
            ", or section_inertia: true, which gives turns of bars about their axes inertia");
  }
}

/// Of forces on a path: where nothing moves they need no shape, and interfaces have theirs.
std::vector<int> loaded_dofs(const ReductionOptions& options, const std::vector<Role>& roles,
                             int d) {
  std::vector<int> loaded;
  for (const NodeDofs& c : options.path)
    for (int axis = 0; axis < d; ++axis)
      if (const int i = c.index * d + axis; ((c.mask >> axis) & 1u) && roles[i] == Role::inner)
        loaded.push_back(i);
  return loaded;
}

}  // namespace

ModeSet craig_bampton_modes(const FeModel& model, const ReductionOptions& options) {
  const int d = model.dofs_per_node();
  const int total = d * model.nodes();
  const SparseMatrix K = assemble_stiffness(model);
  std::vector<Role> roles(total, Role::inner);
  // Rotations of nodes that belong to solid elements only have no stiffness: they are excluded.
  const VecX diagonal = K.diagonal();
  for (int i = 0; i < total; ++i) {
    if (d == 6 && i % 6 >= 3 && diagonal(i) == 0.0) roles[i] = Role::inactive;
  }
  ErrorList errors;
  const auto dof_text = [&](int node, int axis) {
    return model.node_label(node) + " " + node_dof_names[axis];
  };
  for (const NodeDofs& c : options.clamped) {
    const int node = node_of(model, c, "the body reference", errors);
    for (int axis = 0; axis < d && node >= 0; ++axis) {
      if (((c.mask >> axis) & 1u) == 0) continue;
      Role& role = roles[node * d + axis];
      if (role != Role::inactive) role = Role::clamped;
    }
  }
  std::vector<int> interface_dofs;
  std::vector<std::string> names;
  for (const NodeDofs& c : options.interfaces) {
    const int node = node_of(model, c, "the interface", errors);
    if (node < 0) continue;
    if (c.mask == 0)
      errors.add(ErrorCode::missing, {},
                 "the interface at " + model.node_label(node) + " names no degree of freedom");
    for (int axis = 0; axis < 6; ++axis) {
      if (((c.mask >> axis) & 1u) == 0) continue;
      if (axis >= d) {
        errors.add(ErrorCode::contradiction, {},
                   "the interface asks for " + dof_text(node, axis) +
                       ", but the nodes of solid elements have no rotations");
        continue;
      }
      Role& role = roles[node * d + axis];
      if (role == Role::clamped) {
        errors.add(ErrorCode::duplicate, {},
                   dof_text(node, axis) + " is both clamped and an interface degree of freedom");
      } else if (role == Role::interface) {
        errors.add(ErrorCode::duplicate, {},
                   dof_text(node, axis) + " is given twice as an interface degree of freedom");
      } else if (role == Role::inactive) {
        errors.add(ErrorCode::singular, {},
                   dof_text(node, axis) +
                       " has no stiffness and cannot be an interface degree of freedom");
      } else {
        role = Role::interface;
        interface_dofs.push_back(node * d + axis);
        names.push_back("static " +
                        (model.node_names.empty() || model.node_names[node].empty()
                             ? std::to_string(node)
                             : model.node_names[node]) +
                        " " + node_dof_names[axis]);
      }
    }
  }
  errors.throw_if_any();
  check_reference(model, roles, d);

  std::vector<int> zero;
  for (int i = 0; i < total; ++i) {
    const Role role = roles[i];
    if (role == Role::clamped || role == Role::inactive) zero.push_back(i);
  }
  const std::vector<int> loaded = loaded_dofs(options, roles, d);
  ModeSet set = held_modes(model, options, K, eigen_mass(model, options), interface_dofs, zero,
                           loaded, std::move(names));
  if (d == 6)
    check_digits(model, rows_of_nodes(set.X, 0), rows_of_nodes(set.X, 3), set.K.diagonal(),
                 set.names);
  return set;
}

}  // namespace floatframe
