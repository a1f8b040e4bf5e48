#include "floatframe/reduction/part_places.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <set>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/free_turns.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

const Vec3& position(const FeModel& model, int node) { return model.positions[node]; }

Vec3 centre_of(const FeModel& model, const std::vector<int>& nodes) {
  Vec3 c = Vec3::Zero();
  for (const int node : nodes) c += position(model, node);
  return c / static_cast<double>(nodes.size());
}

/// Largest over smallest singular value of the rigid motions of the nodes, lengths in units of
/// their radius of gyration about their centre; on a line without rotation about it.
double condition_of(const FeModel& model, const std::vector<int>& nodes, bool on_line) {
  const Vec3 c = centre_of(model, nodes);
  double size = 0.0;
  for (const int node : nodes) size += (position(model, node) - c).squaredNorm();
  size = std::sqrt(size / static_cast<double>(nodes.size()));
  if (!(size > 0.0)) return 0.0;
  Mat6 A = Mat6::Zero();
  for (const int node : nodes) {
    Eigen::Matrix<double, 3, 6> motion;
    motion << Mat3::Identity(), -skew((position(model, node) - c) / size);
    A += motion.transpose() * motion;
  }
  const VecX e = symmetric_eigenvalues(A);
  const double least = e(on_line ? 1 : 0);
  return least > 0.0 ? std::sqrt(e(5) / least) : std::numeric_limits<double>::infinity();
}

/// By its number in the file: the name is that of the interface.
std::string number_label(const FeModel& model, int node) {
  const std::size_t k = node;
  return "node " + std::to_string(k < model.node_ids.size() ? model.node_ids[k] : node);
}

void append_errors(ErrorList& errors, const InputError& error) {
  for (const ErrorEntry& entry : error.errors()) errors.add(entry);
}

void tie_turns(FeModel& model, const std::vector<InterfacePlace>& interfaces,
               const std::vector<MarkerPlace>& markers) {
  const std::vector<FreeTurn> turns = free_turns(model);
  ErrorList errors;
  for (const FreeTurn& turn : turns) {
    const auto refuse = [&](ErrorCode code, const char* kind, const std::string& name,
                            const std::string& advice) {
      errors.add(
          code, model.mark(turn.source),
          fmt::format(
              "{} '{}': {} is held by nodes without rotations {}, so nothing resists its turn; {}",
              kind, name, turn.label, turn.every_way ? "in one point" : "on one line", advice));
    };
    const auto beside = [&](int node) {
      return fmt::format("a force at {}, away from {}, would turn it", model.node_label(node),
                         turn.every_way ? "that point" : "that line");
    };
    for (const InterfacePlace& place : interfaces) {
      if (is_beside(model, turn, place.node))
        refuse(ErrorCode::singular, "interface", place.name, beside(place.node));
      else if ((place.mask & 56u) != 0 &&
               std::binary_search(turn.group.begin(), turn.group.end(), place.node))
        refuse(ErrorCode::singular, "interface", place.name, "give the interface only ux uy uz");
    }
    for (const MarkerPlace& marker : markers) {
      const auto node = std::find_if(marker.nodes.begin(), marker.nodes.end(),
                                     [&](int k) { return is_beside(model, turn, k); });
      if (marker.residual && node != marker.nodes.end())
        refuse(ErrorCode::singular, "residual marker", marker.name, beside(*node));
    }
  }
  errors.throw_if_any();
  tie_free_turns(model, turns);
  tie_free_turns(model, line_turns(model), false);  // nothing of the user's model rotates there
}

}  // namespace

std::vector<InterfacePlace> place_interfaces(FeModel& model, const PartOptions& options,
                                             const std::vector<MarkerPlace>& markers) {
  ErrorList errors;
  std::vector<InterfacePlace> places;
  for (const InterfaceDescription& d : options.interfaces) {
    if (d.name.empty()) {
      errors.add(ErrorCode::missing, {}, "an interface has no name");
      continue;
    }
    try {
      // Of the user's model: the new reference nodes belong to no set.
      const std::vector<int> nodes = choose_nodes(model, d.choice);
      InterfacePlace place;
      place.name = d.name;
      place.mask = d.mask;
      place.node = add_interface(model, d);
      for (const InterfacePlace& other : places) {
        if (other.node == place.node)
          throw InputError(
              ErrorCode::duplicate,
              fmt::format("the interfaces '{}' and '{}' are the same node", other.name, d.name));
      }
      InterfaceHealth& h = place.health;
      h.name = d.name;
      h.nodes = static_cast<int>(nodes.size());
      h.p = position(model, place.node);
      h.kind = d.kind == Spider::Kind::rigid ? "rigid" : "mean";
      if (nodes.size() == 1) {
        h.kind = "node";
      } else {
        const bool mean = d.kind == Spider::Kind::mean && !model.spiders.empty();
        h.condition = condition_of(model, nodes, mean && (model.spiders.back().mask & 56u) != 56u);
      }
      places.push_back(std::move(place));
    } catch (const InputError& error) {
      append_errors(errors, error);
    }
  }
  errors.throw_if_any();
  tie_turns(model, places, markers);
  return places;
}

std::vector<MarkerPlace> place_markers(const FeModel& model, const PartOptions& options) {
  ErrorList errors;
  std::vector<MarkerPlace> places;
  std::set<std::string> names;
  for (const InterfaceDescription& d : options.interfaces) names.insert(d.name);
  for (const MarkerDescription& d : options.markers) {
    const std::string label = "marker '" + d.name + "': ";
    if (d.name.empty()) errors.add(ErrorCode::missing, {}, "a marker has no name");
    if (!names.insert(d.name).second)
      errors.add(ErrorCode::duplicate, {}, label + "the name is given twice");
    try {
      MarkerPlace place;
      place.name = d.name;
      place.residual = d.residual;
      place.nodes = choose_nodes(model, d.choice);
      place.p = d.at.value_or(centre_of(model, place.nodes));
      if (!place.p.allFinite())
        throw InputError(ErrorCode::not_finite, "its position is not finite");
      places.push_back(std::move(place));
    } catch (const InputError& error) {
      for (const ErrorEntry& entry : error.errors())
        errors.add(entry.code, entry.mark, label + entry.message, entry.count);
    }
  }
  errors.throw_if_any();
  return places;
}

void find_rows(const FeModel& model, const FeSystem& system,
               std::vector<InterfacePlace>& interfaces) {
  ErrorList errors;
  int count = 0;
  const VecX stiffness = system.K.diagonal(), mass = system.M.diagonal();
  for (InterfacePlace& place : interfaces) {
    place.first = count;
    std::string loose;
    for (int axis = 0; axis < 6; ++axis) {
      if (((place.mask >> axis) & 1u) == 0) continue;
      const int row = system.row(place.node, axis);
      if (row < 0) {
        errors.add(ErrorCode::missing, {},
                   fmt::format("interface '{}': {} has no degree of freedom {} of its own",
                               place.name, model.node_label(place.node), node_dof_names[axis]));
        continue;
      }
      place.rows.push_back(row);
      place.axes.push_back(axis);
      ++count;
      if (stiffness(row) == 0.0 && mass(row) == 0.0)
        loose += std::string(loose.empty() ? "" : ", ") + node_dof_names[axis];
    }
    // Rejected like an inner node: the reference of a coupling of some directions only.
    if (!loose.empty())
      errors.add(ErrorCode::singular, {},
                 fmt::format("interface '{}': {} can move without resistance in {}: nothing of the "
                             "part follows it there",
                             place.name, number_label(model, place.node), loose));
  }
  errors.throw_if_any();
}

void find_motions(const FeModel& model, const FeSystem& system, std::vector<MarkerPlace>& markers) {
  const Eigen::Index rows = 3 * static_cast<Eigen::Index>(model.nodes());
  for (MarkerPlace& marker : markers) {
    const Vec3 c = centre_of(model, marker.nodes);
    const double weight = 1.0 / static_cast<double>(marker.nodes.size());
    const bool single = marker.nodes.size() == 1;
    // theta = J^+ sum r x u, J = sum (r^2 I - r r^T)
    Mat3 J = Mat3::Zero();
    for (const int node : marker.nodes) {
      const Vec3 r = position(model, node) - c;
      J += r.squaredNorm() * Mat3::Identity() - r * r.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Mat3> eigen(J);
    Mat3 inverse = Mat3::Zero();
    for (int k = 0; k < 3; ++k) {
      const double e = eigen.eigenvalues()(k);
      if (!(e > 1e-8 * eigen.eigenvalues()(2))) continue;
      inverse += eigen.eigenvectors().col(k) * eigen.eigenvectors().col(k).transpose() / e;
    }
    std::vector<Eigen::Triplet<double>> mean, turn;
    const auto add = [](std::vector<Eigen::Triplet<double>>& to, int node, const Mat3& A) {
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
          if (A(i, j) != 0.0) to.emplace_back(i, 3 * node + j, A(i, j));
    };
    for (const int node : marker.nodes) {
      add(mean, node, weight * Mat3::Identity());
      if (single) {
        add(turn, node, Mat3::Identity());
      } else {
        add(turn, node, inverse * skew(position(model, node) - c));
      }
    }
    SparseRows W(3, rows), V(3, rows);
    W.setFromTriplets(mean.begin(), mean.end());
    V.setFromTriplets(turn.begin(), turn.end());
    marker.rotation = V * (single ? system.T_theta : system.T);
    SparseRows arm(3, 3);
    const Mat3 S = -skew(marker.p - c);
    std::vector<Eigen::Triplet<double>> entries;
    add(entries, 0, S);
    arm.setFromTriplets(entries.begin(), entries.end());
    const SparseRows by_rotation = arm * marker.rotation;
    marker.translation = W * system.T;
    marker.translation += by_rotation;
    marker.by_translations = W;
    marker.turn_by_translations.resize(3, rows);
    if (single) continue;
    marker.by_translations += SparseRows(arm * V);
    marker.turn_by_translations = V;
  }
}

}  // namespace floatframe
