#include "floatframe/fe/interface_selection.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "floatframe/core/suggest.hpp"
#include "floatframe/fe/dependent_dofs.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/math/vector_text.hpp"

namespace floatframe {
namespace {

const Vec3& node_position(const FeModel& model, int node) { return model.positions[node]; }

std::string lower(std::string s) {
  for (char& c : s) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return s;
}

/// By its name, else by the only name that differs in upper and lower case.
template <class Map>
const typename Map::mapped_type* find_set(const Map& sets, const std::string& name) {
  if (const auto it = sets.find(name); it != sets.end()) return &it->second;
  const typename Map::mapped_type* found = nullptr;
  for (const auto& [key, value] : sets) {
    if (lower(key) != lower(name)) continue;
    if (found) return nullptr;
    found = &value;
  }
  return found;
}

void ascending(std::vector<int>& nodes) {
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
}

std::vector<int> nodes_of_set(const FeModel& model, const std::string& name) {
  std::vector<int> nodes;
  if (const auto* set = find_set(model.node_sets, name)) {
    // The order of the set, each node once.
    std::vector<char> seen(model.positions.size(), 0);
    for (const int node : *set) {
      if (seen[node]++ == 0) nodes.push_back(node);
    }
  } else if (const auto* elements = find_set(model.element_sets, name)) {
    for (const int e : *elements) {
      const FeElement& element = model.elements[e];
      const int count = element_kernel(element.type).nodes;
      nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.begin() + count);
    }
    ascending(nodes);
  } else if (const auto* surface = find_set(model.surfaces, name)) {
    for (const ElementFace& f : *surface) {
      const FeElement& element = model.elements[f.element];
      const FaceNodes& face = element_faces(element.type)[f.face];
      for (int i = 0; i < face.count; ++i) {
        const int a = face.nodes[i];
        nodes.push_back(element.nodes[a]);
      }
    }
    ascending(nodes);
  } else {
    std::vector<std::string> known;
    for (const auto& [key, value] : model.node_sets) known.push_back(key);
    for (const auto& [key, value] : model.element_sets) known.push_back(key);
    for (const auto& [key, value] : model.surfaces) known.push_back(key);
    std::sort(known.begin(), known.end());
    known.erase(std::unique(known.begin(), known.end()), known.end());
    const std::string hint = did_you_mean(name, known);
    if (known.empty()) {
      throw InputError(ErrorCode::not_found,
                       fmt::format("there is no set '{}'; the model has no sets", name));
    }
    std::string list;
    for (std::size_t i = 0; i < known.size() && i < 12; ++i) {
      list += (i == 0 ? "'" : ", '") + known[i] + "'";
    }
    if (known.size() > 12) list += fmt::format(" and {} more", known.size() - 12);
    throw InputError(ErrorCode::not_found,
                     fmt::format("there is no set '{}'{}{}", name,
                                 hint.empty() ? "; the sets are " : hint + " The sets are ", list));
  }
  if (nodes.empty())
    throw InputError(ErrorCode::missing, fmt::format("the set '{}' is empty", name));
  return nodes;
}

double size_of(const FeModel& model, const std::vector<char>& used) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < model.nodes(); ++k) {
    if (used[k] != 0) box.extend(node_position(model, k));
  }
  return box.isEmpty() ? 0.0 : box.diagonal().norm();
}

double size_of_used(const FeModel& model, const DofTable& table) {
  std::vector<char> used(model.positions.size(), 0);
  for (int k = 0; k < model.nodes(); ++k) used[k] = table.count(k) > 0;
  return size_of(model, used);
}

/// Of the choice's plane, cylinder or sphere; along the axis beyond the length as well.
double distance(const NodeChoice& c, const Vec3& axis, const Vec3& p) {
  const Vec3 r = p - c.point;
  if (c.by == NodeChoice::By::plane) return std::abs(axis.dot(r));
  if (c.by == NodeChoice::By::cylinder) {
    const double z = axis.dot(r);
    const double radial = std::abs((r - z * axis).norm() - c.radius);
    const double beyond = c.length > 0.0 ? std::max(0.0, std::abs(z) - 0.5 * c.length) : 0.0;
    return std::max(radial, beyond);
  }
  if (c.by == NodeChoice::By::sphere) return std::abs(r.norm() - c.radius);
  return r.norm();
}

std::string describe(const NodeChoice& c) {
  switch (c.by) {
    case NodeChoice::By::plane:
      return fmt::format("the plane through {} with the normal {}", vector_text(c.point),
                         vector_text(c.axis));
    case NodeChoice::By::cylinder:
      return fmt::format("the cylinder of radius {:.6g} m about the axis {} through {}{}", c.radius,
                         vector_text(c.axis), vector_text(c.point),
                         c.length > 0.0 ? fmt::format(", {:.6g} m long", c.length) : "");
    default:
      return fmt::format("the sphere of radius {:.6g} m about {}", c.radius, vector_text(c.point));
  }
}

std::vector<int> nodes_of_shape(const FeModel& model, const NodeChoice& c) {
  std::vector<char> used(model.positions.size(), 0);
  const DofTable table = dof_table(model);
  for (int k = 0; k < model.nodes(); ++k) used[k] = table.count(k) > 0;
  for (const int made : model.generated_nodes) used[made] = 0;
  const bool round = c.by == NodeChoice::By::cylinder || c.by == NodeChoice::By::sphere;
  if (round && !(c.radius > 0.0)) {
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("the radius must be positive, not {:.6g}", c.radius));
  }
  Vec3 axis = Vec3::Zero();
  if (c.by == NodeChoice::By::plane || c.by == NodeChoice::By::cylinder) {
    if (!(c.axis.norm() > 0.0)) throw InputError(ErrorCode::geometry, "the axis has zero length");
    axis = c.axis.normalized();
  }
  const double size = size_of(model, used);
  const double tolerance = c.tolerance > 0.0 ? c.tolerance : 1e-3 * (round ? c.radius : size);
  std::vector<int> nodes;
  int best = -1;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < model.nodes(); ++k) {
    if (used[k] == 0) continue;
    const double d = distance(c, axis, node_position(model, k));
    if (d < (1.0 - 1e-9) * least) least = d, best = k;  // first of equal ones
    if (d <= tolerance) nodes.push_back(k);
  }
  if (best < 0)
    throw InputError(ErrorCode::missing, "the model has no node that belongs to an element");
  if (c.by == NodeChoice::By::nearest) return {best};
  if (nodes.empty()) {
    throw InputError(
        ErrorCode::not_found,
        fmt::format("no node lies within {:.3g} m of {}; the nearest is {} at {:.3g} m", tolerance,
                    describe(c), model.node_label(best), least));
  }
  return nodes;
}

/// Smallest width of the cloud of nodes against its largest but one: on a line if tiny.
/// The direction of the line if the nodes are collinear.
std::optional<Vec3> line_of(const FeModel& model, const std::vector<int>& nodes) {
  Vec3 centre = Vec3::Zero();
  for (const int node : nodes) centre += node_position(model, node);
  centre /= static_cast<double>(nodes.size());
  Mat3 second = Mat3::Zero();
  for (const int node : nodes) {
    const Vec3 r = node_position(model, node) - centre;
    second += r * r.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Mat3> form(second);
  const Vec3 e = form.eigenvalues();
  if (e(1) > 1e-10 * e(2)) return std::nullopt;
  return Vec3(form.eigenvectors().col(2));
}

/// Mean motion of nodes on a line: the mask of the spider, without the turns that have a part about
/// the line, which the interface must not have. Throws InputError.
unsigned mask_on_line(const InterfaceDescription& d, const Vec3& line, std::size_t nodes) {
  unsigned about = 0;
  for (unsigned k = 0; k < 3; ++k)
    if (std::abs(line(k)) > 1e-6) about |= 8u << k;
  if (d.kind == Spider::Kind::mean && (d.mask & about) == 0) return 63u & ~about;
  std::string named;
  for (unsigned k = 3; k < 6; ++k)
    if (d.mask & about & (1u << k))
      named += (named.empty() ? "" : ", ") + std::string(node_dof_words[k]);
  throw InputError(
      ErrorCode::singular,
      fmt::format(
          "its {} nodes lie on a line, about which nothing holds the rotation of the reference "
          "point; choose nodes off the line too, or type mean and dofs without {}",
          nodes, named.empty() ? "the rotation about it" : named));
}

Vec3 reference_point(const FeModel& model, const NodeChoice& c, const std::vector<int>& nodes) {
  Eigen::AlignedBox3d box;
  for (const int node : nodes) box.extend(node_position(model, node));
  const Vec3 centre = box.center();
  if (c.by == NodeChoice::By::sphere) return c.point;
  if (c.by == NodeChoice::By::plane) {
    const Vec3 n = c.axis.normalized();
    return centre - n * n.dot(centre - c.point);
  }
  if (c.by == NodeChoice::By::cylinder) {
    // The middle of the nodes' extent along the axis.
    const Vec3 a = c.axis.normalized();
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const int node : nodes) {
      const double z = a.dot(node_position(model, node) - c.point);
      low = std::min(low, z);
      high = std::max(high, z);
    }
    return c.point + 0.5 * (low + high) * a;
  }
  return centre;
}

std::string the_spider(const FeModel& model, const Spider& s) {
  return s.name.empty() ? "the spider of " + model.node_label(s.reference)
                        : "spider '" + s.name + "'";
}

void name_node(FeModel& model, int node, const std::string& name) {
  model.node_names.resize(model.positions.size());
  model.node_names[node] = name;
}

/// Elements of a node without rotations; bars without a torsion constant are rods and springs.
const char* elements_without_rotations(const FeModel& model, int node) {
  bool rods = false, solids = false, membranes = false;
  for (const FeElement& e : model.elements) {
    if (std::find(e.nodes.begin(), e.nodes.begin() + element_nodes(e.type), node) ==
        e.nodes.begin() + element_nodes(e.type))
      continue;
    rods = rods || is_rod(e.type);
    membranes = membranes || is_membrane(e.type) || is_panel(e.type);
    solids = solids || element_kernel(e.type).family == ElementFamily::solid;
  }
  if (solids) return "solid elements";
  if (membranes) return "membranes or shear panels";
  return rods ? "rods (bars whose I1, I2 or J is 0 are rods)" : "no element that turns";
}

/// A node that has six dofs, or a single node.
std::optional<int> existing_reference(const FeModel& model, const InterfaceDescription& d,
                                      const DofTable& table, const std::vector<int>& nodes) {
  std::vector<int> sorted = nodes;
  ascending(sorted);
  for (const Spider& s : model.spiders) {
    std::vector<int> theirs = s.nodes;
    ascending(theirs);
    if (theirs != sorted) continue;
    const Vec3& there = node_position(model, s.reference);
    if (d.at && (*d.at - there).norm() > 1e-6 * (size_of_used(model, table) + there.norm())) {
      throw InputError(ErrorCode::dependent,
                       fmt::format("{} ties these nodes to a reference at {} already; the "
                                   "reference point {} is another one",
                                   the_spider(model, s), vector_text(there), vector_text(*d.at)));
    }
    return s.reference;
  }
  if (nodes.size() != 1) return std::nullopt;
  if (table.count(nodes[0]) == 3 && (d.mask & 56u) != 0) {
    throw InputError(
        ErrorCode::wrong_value,
        fmt::format("{} belongs to {} and has no rotations; an interface of one such node can only "
                    "have ux uy uz",
                    model.node_label(nodes[0]), elements_without_rotations(model, nodes[0])));
  }
  return nodes[0];
}

int add_unnamed(FeModel& model, const InterfaceDescription& d) {
  const std::vector<int> nodes = choose_nodes(model, d.choice);
  const DofTable table = dof_table(model);
  ErrorList errors;
  for (const int node : nodes) {
    if (table.count(node) > 0) continue;
    errors.add(ErrorCode::missing, {}, model.node_label(node) + " belongs to no element");
    break;
  }
  errors.throw_if_any();
  if (const auto node = existing_reference(model, d, table, nodes)) {
    for (const Spider& s : model.spiders) {
      if (s.kind == Spider::Kind::rigid && nodes.size() == 1 && s.reference != *node &&
          std::find(s.nodes.begin(), s.nodes.end(), *node) != s.nodes.end()) {
        throw InputError(ErrorCode::dependent,
                         fmt::format("{} belongs to {} and cannot be an interface of its own",
                                     model.node_label(*node), the_spider(model, s)));
      }
    }
    return *node;
  }
  const bool rotations =
      std::any_of(nodes.begin(), nodes.end(), [&](int node) { return table.count(node) == 6; });
  unsigned mask = 63u;
  if (d.kind == Spider::Kind::mean || !rotations) {
    if (nodes.size() < 3) {
      throw InputError(
          ErrorCode::wrong_count,
          fmt::format("{} nodes are too few; an interface of solid elements needs three that do "
                      "not lie on a line, or one node with only ux uy uz",
                      nodes.size()));
    }
    if (const auto line = line_of(model, nodes)) mask = mask_on_line(d, *line, nodes.size());
  }
  for (const Spider& s : model.spiders) {
    if (d.kind == Spider::Kind::mean && s.kind == Spider::Kind::mean) continue;
    for (const int node : nodes) {
      if (std::find(s.nodes.begin(), s.nodes.end(), node) == s.nodes.end()) continue;
      errors.add(ErrorCode::dependent, {},
                 model.node_label(node) + " belongs to " + the_spider(model, s) +
                     " already; a node can follow only one reference");
      break;
    }
  }
  errors.throw_if_any();
  Spider spider;
  spider.kind = d.kind;
  spider.name = d.name;
  spider.reference = model.nodes();
  spider.nodes = nodes;
  spider.mask = mask;
  const Vec3 at = d.at.value_or(reference_point(model, d.choice, nodes));
  if (!at.allFinite()) throw InputError(ErrorCode::not_finite, "the reference point is not finite");
  model.positions.push_back(at);
  if (!model.node_ids.empty()) {
    model.node_ids.push_back(*std::max_element(model.node_ids.begin(), model.node_ids.end()) + 1);
  }
  if (!model.node_sources.empty()) model.node_sources.emplace_back();
  model.spiders.push_back(std::move(spider));
  return model.nodes() - 1;
}

}  // namespace

std::vector<int> choose_nodes(const FeModel& model, const NodeChoice& choice) {
  if (choice.by == NodeChoice::By::set) return nodes_of_set(model, choice.set);
  if (choice.by != NodeChoice::By::node) return nodes_of_shape(model, choice);
  for (int k = 0; k < model.nodes(); ++k) {
    const int id = model.node_ids.empty() ? k + 1 : model.node_ids[k];
    if (id == choice.number) return {k};
  }
  throw InputError(ErrorCode::not_found, fmt::format("there is no node {}", choice.number));
}

int add_interface(FeModel& model, const InterfaceDescription& d) {
  const std::string label = "interface '" + d.name + "': ";
  try {
    if (model.find_node(d.name) >= 0)
      throw InputError(ErrorCode::duplicate, "a node has this name already");
    if ((d.mask & 63u) == 0) throw InputError(ErrorCode::missing, "it has no degree of freedom");
    const int node = add_unnamed(model, d);
    name_node(model, node, d.name);
    return node;
  } catch (const InputError& error) {
    std::vector<ErrorEntry> errors = error.errors();
    for (ErrorEntry& entry : errors) entry.message = label + entry.message;
    throw InputError(std::move(errors));
  }
}

}  // namespace floatframe
