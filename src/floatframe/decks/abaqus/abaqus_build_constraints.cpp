// Surfaces, spiders, equations and supports of an Abaqus deck in the model.
#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/face_weights.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/formats/text/text_fields.hpp"

namespace floatframe {
namespace {

/// Collects nodes without duplicates, with the sum of their weights.
class NodeList {
 public:
  void exclude(int node) { place_[node] = -1; }
  void add(int node, double weight) {
    const auto [it, fresh] = place_.try_emplace(node, static_cast<int>(nodes.size()));
    if (it->second < 0) return;
    if (fresh) {
      nodes.push_back(node);
      weights.push_back(0.0);
    }
    weights[it->second] += weight;
  }
  std::vector<int> nodes;
  std::vector<double> weights;

 private:
  std::unordered_map<int, int> place_;  // -1: excluded
};

/// Faces of the elements of a surface.
std::vector<ElementFace> faces_of(AbaqusBuild& build, const AbaqusSurface& surface,
                                  const std::string& name) {
  std::vector<ElementFace> faces;
  const std::size_t before = build.source.errors();
  for (const AbaqusSurface::Item& item : surface.items) {
    for (const int e : build.elements.resolve(item.where)) {
      const int index = build.element_index[e];
      const AbaqusElement& element = build.content.elements[e];
      const std::size_t count =
          index < 0 ? 0 : element_faces(build.model.elements[index].type).size();
      if (static_cast<std::size_t>(item.face) >= count) {
        build.source.error(ErrorCode::not_found, item.where.at, "surface {}: {} has no face {}",
                           shown(name), abaqus_label(element), item.face + 1);
        break;
      }
      faces.push_back({index, item.face});
    }
  }
  if (faces.empty() && build.source.errors() == before)
    build.source.error(ErrorCode::missing, surface.at, "surface {} is empty", shown(name));
  return faces;
}

void build_surfaces(AbaqusBuild& build) {
  const AbaqusContent& c = build.content;
  for (const auto& [key, surface] : c.surfaces) {
    const std::string name = abaqus_model_name(c, key, c.surfaces);
    if (!surface.of_nodes) {
      build.model.surfaces[name] = faces_of(build, surface, name);
      continue;
    }
    std::vector<int> nodes = abaqus_surface_nodes(build, surface);
    if (!surface.internal && !nodes.empty()) build.model.node_sets.emplace(name, std::move(nodes));
  }
}

void add_surface(AbaqusBuild& build, const AbaqusSpider& spider, NodeList& list) {
  std::string name;
  const AbaqusSurface* const surface = find_abaqus_surface(build, *spider.surface, name);
  if (surface == nullptr) return;
  if (surface->of_nodes) {
    for (const AbaqusSurface::Item& item : surface->items)
      for (const int node : build.nodes.resolve(item.where)) list.add(node, item.weight);
    return;
  }
  const FeModel& model = build.model;
  for (const ElementFace& f : model.surfaces.at(name)) {
    const FeElement& element = model.elements[f.element];
    const FaceNodes& face = element_faces(element.type)[f.face];
    std::vector<Vec3> corners;
    for (int k = 0; k < face.corners; ++k)
      corners.push_back(model.positions[element.nodes[face.nodes[k]]]);
    const std::vector<double> weights = face_weights(corners, face.count);
    for (int k = 0; k < face.count; ++k) list.add(element.nodes[face.nodes[k]], weights[k]);
  }
}

/// The reference of a spider; -1 and an error if it is not one node.
int reference_of(AbaqusBuild& build, const AbaqusSpider& raw) {
  if (!raw.reference_by_element) return build.nodes.one(raw.where, "reference node");
  const int e = build.elements.one(raw.where, "*DISTRIBUTING COUPLING");
  if (e < 0) return -1;
  const AbaqusElement& element = build.content.elements[e];
  if (element.type->family == AbaqusType::Family::coupling) return build.node_of(element, 0);
  build.source.error(ErrorCode::wrong_value, raw.where.at,
                     "*DISTRIBUTING COUPLING names {}, expected one of type DCOUP3D",
                     abaqus_label(element));
  return -1;
}

void build_spider(AbaqusBuild& build, const AbaqusSpider& raw, bool only_nodes) {
  Spider spider = raw.in_model;
  spider.source = raw.where.at;
  const std::size_t before = build.source.errors();
  spider.reference = reference_of(build, raw);
  if (raw.rotation) {
    spider.rotation_node = build.nodes.one(*raw.rotation, "rotation node");
    if (spider.rotation_node == spider.reference) spider.rotation_node = -1;
  }
  NodeList list;
  list.exclude(spider.reference);
  list.exclude(spider.rotation_node);
  for (std::size_t k = 0; k < raw.nodes.size(); ++k) {
    const double weight = raw.weights.empty() ? 1.0 : raw.weights[k];
    for (const int node : build.nodes.resolve(raw.nodes[k])) list.add(node, weight);
  }
  for (const AbaqusReference& elements : raw.elements)
    for (const int node : build.nodes_of_elements(build.elements.resolve(elements)))
      list.add(node, 1.0);
  if (raw.surface && !only_nodes) add_surface(build, raw, list);
  if (build.source.errors() != before) return;
  if (list.nodes.empty() && !only_nodes)
    return build.source.error(ErrorCode::missing, raw.where.at,
                              "the rigid body or coupling has no nodes but its reference");
  spider.nodes = list.nodes;
  if (spider.kind == Spider::Kind::mean) spider.weights = list.weights;
  build.model.spiders.push_back(std::move(spider));
}

/// By rotation nodes: their references, whose rotations are their displacements.
using Rotations = std::map<int, int>;

Dof meant_dof(const Rotations& rotations, int node, int axis) {
  const auto it = rotations.find(node);
  return it == rotations.end() ? Dof{node, axis} : Dof{it->second, axis % 3 + 3};
}

/// A term in body axes: for a node with rotated axes one per axis.
void add_term(LinearEquation& equation, const Dof& dof, double factor,
              const std::map<int, Mat3>& axes) {
  const auto it = axes.find(dof.node);
  if (it == axes.end()) {
    equation.terms.push_back({dof.node, dof.axis, factor});
    return;
  }
  const int first = dof.axis / 3 * 3;
  const Vec3 direction = it->second.col(dof.axis - first);
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  for (int k = 0; k < 3; ++k) {
    const int axis = (static_cast<int>(largest) + k) % 3;
    if (std::abs(direction(axis)) > 1e-15)
      equation.terms.push_back({dof.node, first + axis, factor * direction(axis)});
  }
}

void build_equation(AbaqusBuild& build, const AbaqusEquation& raw, const Rotations& rotations,
                    const std::map<int, Mat3>& axes) {
  std::vector<std::vector<int>> nodes;
  const std::size_t before = build.source.errors();
  for (const AbaqusEquation::Term& term : raw.terms) {
    nodes.push_back(build.nodes.resolve(term.where));
    if (build.source.errors() != before) return;
    if (nodes.back().size() != 1 && nodes.back().size() != nodes.front().size())
      return build.source.error(ErrorCode::wrong_count, raw.at,
                                "*EQUATION: {} has {} nodes, expected 1 or {} as in the first term",
                                build.content.text(term.where, "node"), nodes.back().size(),
                                nodes.front().size());
  }
  build.nodes.spend(nodes.front().size() * raw.terms.size(), raw.at);
  for (std::size_t k = 0; k < nodes.front().size(); ++k) {
    LinearEquation equation{{}, raw.at};
    for (std::size_t t = 0; t < raw.terms.size(); ++t)
      add_term(equation,
               meant_dof(rotations, nodes[t][nodes[t].size() == 1 ? 0 : k], raw.terms[t].axis),
               raw.terms[t].factor, axes);
    build.model.equations.push_back(std::move(equation));
  }
}

/// A node that follows in some directions only follows in its own axes.
void check_turned_spiders(AbaqusBuild& build, const std::map<int, Mat3>& axes) {
  if (axes.empty()) return;
  for (const Spider& s : build.model.spiders) {
    const unsigned translations = s.mask & 7u, rotations = s.mask >> 3;
    if (s.kind == Spider::Kind::mean ||
        ((translations == 0 || translations == 7u) && (rotations == 0 || rotations == 7u)))
      continue;
    for (const int node : s.nodes) {
      if (!axes.contains(node)) continue;
      build.source.error(
          ErrorCode::unsupported, s.source,
          "{} follows in some directions only, and *TRANSFORM turns them, which is not supported",
          build.model.node_label(node));
      break;
    }
  }
}

}  // namespace

std::vector<int> abaqus_surface_nodes(AbaqusBuild& build, const AbaqusSurface& surface) {
  std::vector<int> nodes;
  for (const AbaqusSurface::Item& item : surface.items) {
    const std::vector<int> found = build.nodes.resolve(item.where);
    nodes.insert(nodes.end(), found.begin(), found.end());
  }
  return nodes;
}

const AbaqusSurface* find_abaqus_surface(AbaqusBuild& build, const AbaqusReference& reference,
                                         std::string& shown_name) {
  const AbaqusContent& c = build.content;
  const AbaqusNamed<AbaqusSurface> found =
      find_abaqus_name(c, c.surfaces, reference.scope, reference.name);
  if (found.entry != nullptr) {
    shown_name = abaqus_model_name(c, found.entry->first, c.surfaces);
    return &found.entry->second;
  }
  const std::string& name = c.names[reference.name];
  if (found.several)
    build.source.error(
        ErrorCode::duplicate, reference.at,
        "surface {} is in several instances: put the name of one and a dot before it", shown(name));
  else
    build.source.error(ErrorCode::not_found, reference.at, "surface {} does not exist{}",
                       shown(name), did_you_mean(name, abaqus_names_of(c, c.surfaces)));
  return nullptr;
}

void build_abaqus_constraints(AbaqusBuild& build, bool only_nodes) {
  const AbaqusContent& c = build.content;
  if (!only_nodes) {
    build_surfaces(build);
    std::string name;
    for (const AbaqusThing& p : c.pre_tensions) find_abaqus_surface(build, p.where, name);
    build.source.throw_if_any();
  }
  for (const AbaqusSpider& spider : c.spiders) build_spider(build, spider, only_nodes);
  Rotations rotations;
  for (const Spider& s : build.model.spiders)
    if (s.rotation_node >= 0) rotations.emplace(s.rotation_node, s.reference);
  const std::map<int, Mat3> axes = abaqus_node_axes(build);
  // A *MPC gives several equations: one error is enough.
  FeSource wrong;
  for (const AbaqusEquation& equation : c.equations) {
    if (equation.at.file == wrong.file && equation.at.line == wrong.line) continue;
    const std::size_t before = build.source.errors();
    build_equation(build, equation, rotations, axes);
    if (build.source.errors() != before) wrong = equation.at;
  }
  for (const AbaqusSupport& support : c.supports)
    for (const int node : build.nodes.resolve(support.where))
      build.model.supports.push_back(
          {meant_dof(rotations, node, 0).node,
           rotations.contains(node) ? (support.mask & 7u) << 3 : support.mask, support.where.at});
  check_turned_spiders(build, axes);
  if (!only_nodes && build.source.errors() == 0) build_abaqus_ties(build);
  build.arms.tie(build.model);
}

}  // namespace floatframe
