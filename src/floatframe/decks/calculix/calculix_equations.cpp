// Knots are nodes of beams whose rotations CalculiX keeps. It expands beams to solids. Beams that
// meet at a node share the expanded nodes if they are in one line; else CalculiX joins the nodes
// of each by a rigid knot, and rotations of the node in equations are those of the knot. Beams are
// in one line if their tangents and normals are within 20 degrees of those of the beam with the
// smallest number and the same section and offsets (gen3dnor.f of CalculiX 2.20).
#include <algorithm>
#include <cmath>

#include "floatframe/decks/calculix/calculix_text.hpp"
#include "floatframe/fe/beam_tangent.hpp"
#include "floatframe/fe/node_dof_names.hpp"
#include "floatframe/math/rigid_motion.hpp"

namespace floatframe {
namespace {

/// cos 20 degrees
constexpr double within_20_degrees = 0.939693;

/// A beam at a node.
struct BeamEnd {
  int number = 0;  ///< of the element in the deck
  Vec3 tangent = Vec3::Zero(), normal = Vec3::Zero();
  std::array<double, 2> thickness{}, offset{};
  bool rectangle = false;
};

BeamEnd beam_end(const CalculixText& deck, std::size_t element, int k) {
  const FeModel& model = deck.model;
  const FeElement& e = model.elements[element];
  const BeamSection& section = model.sections[e.section];
  const int count = element_nodes(e.type);
  std::array<Vec3, 3> at{};
  for (int i = 0; i < count; ++i) at[i] = model.positions[e.nodes[i]];
  BeamEnd end;
  end.number = deck.element(element);
  end.tangent = beam_tangent(at, count, k).normalized();
  end.normal = end.tangent.cross(e.reference).normalized();
  end.rectangle = section.outline == BeamSection::Outline::rectangle;
  end.thickness = {section.width, end.rectangle ? section.height : section.width};
  if (deck.beside != nullptr) end.offset = deck.beside->offsets[element];
  return end;
}

/// Does CalculiX expand it to other nodes than `first`? Round sections may be pipes.
bool is_apart(const BeamEnd& e, const BeamEnd& first) {
  const auto differ = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::abs(a[0] - b[0]) > 1e-9 || std::abs(a[1] - b[1]) > 1e-9;
  };
  return !(e.tangent.dot(first.tangent) > within_20_degrees) ||
         !(e.normal.dot(first.normal) > within_20_degrees) ||
         differ(e.thickness, first.thickness) || differ(e.offset, first.offset) ||
         e.rectangle != first.rectangle;
}

/// Numbers, in the deck, of the nodes with knots that only beams have.
std::set<int> knots_of(const CalculixText& deck) {
  const FeModel& model = deck.model;
  std::map<int, std::vector<BeamEnd>> ends;  // by nodes
  std::set<int> others;
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const FeElement& e = model.elements[i];
    const bool beam = is_beam(e.type) && e.section >= 0 &&
                      static_cast<std::size_t>(e.section) < model.sections.size();
    for (int k = 0; k < element_nodes(e.type); ++k) {
      const int node = e.nodes[k];
      if (beam)
        ends[node].push_back(beam_end(deck, i, k));
      else
        others.insert(node);
    }
  }
  std::set<int> out;
  for (const auto& [node, list] : ends) {
    if (others.contains(node)) continue;
    const BeamEnd& first =
        *std::min_element(list.begin(), list.end(),
                          [](const BeamEnd& a, const BeamEnd& b) { return a.number < b.number; });
    if (std::any_of(list.begin(), list.end(), [&](const BeamEnd& e) { return is_apart(e, first); }))
      out.insert(deck.node(node));
  }
  return out;
}

/// Numbers of the nodes whose displacements are the rotations of another node; 0: none.
std::vector<int> add_rotation_nodes(CalculixText& deck, const DofTable& table) {
  const FeModel& model = deck.model;
  const std::vector<char> bends = nodes_of_elements(
      model, [](const FeElement& e) { return element_kernel(e.type).dofs_per_node == 6; });
  std::vector<int> out(model.positions.size(), 0);
  for (const Spider& s : model.spiders)
    if (s.rotation_node >= 0) out[s.reference] = deck.node(s.rotation_node);
  std::string lines;
  int& last = deck.numbers.last_node;
  for (int n = 0; n < model.nodes(); ++n) {
    if (table.count(n) < 6 || bends[n] != 0 || out[n] != 0) continue;
    out[n] = ++last;
    lines += calculix_node(last, model.positions[n]);
  }
  if (!lines.empty()) deck.text += "** Their displacements are rotations of nodes\n*NODE\n" + lines;
  return out;
}

/// Description of the constraint on a node, for a message.
FeSource source_of_tie(const FeModel& model, int node) {
  for (const Spider& s : model.spiders)
    if (s.reference == node || std::find(s.nodes.begin(), s.nodes.end(), node) != s.nodes.end())
      return s.source;
  for (const LinearEquation& e : model.equations)
    for (const LinearEquation::Term& t : e.terms)
      if (t.node == node) return e.source;
  return {};
}

/// For each node without elements the dofs of its six motions, one column each: by row the factor.
using NodeColumns = std::map<int, std::array<std::map<int, double>, 6>>;

/// Masses, which have no inertia in a deck, and springs; `row` counts.
void add_masses_and_springs(const FeModel& model, const std::vector<char>& in_elements, int row,
                            NodeColumns& columns) {
  for (const PointMass& m : model.masses)
    if (in_elements[m.node] == 0 && m.mass != 0.0)
      for (std::size_t axis = 0; axis < 3; ++axis) columns[m.node][axis][row++] = 1.0;
  for (const Spring& s : model.springs)
    for (std::size_t end = 0; end < 2; ++end) {
      const int node = s.nodes[end];
      if (node < 0 || in_elements[node] != 0) continue;
      for (std::size_t axis = 0; axis < 6; ++axis)
        if (const double d = s.directions[end](static_cast<int>(axis)); d != 0.0)
          columns[node][axis][row] = d;
      ++row;
    }
}

/// Sparse columns that are sums of the previous ones. For a node of springs, whose
/// displacements all exist in CalculiX, also empty ones.
std::vector<std::size_t> repeated_columns(const std::array<std::map<int, double>, 6>& columns,
                                          bool sprung) {
  std::map<int, int> rows;
  for (const auto& column : columns)
    for (const auto& [row, value] : column) rows.try_emplace(row, static_cast<int>(rows.size()));
  std::vector<std::size_t> out;
  std::vector<VecX> basis;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    VecX x = VecX::Zero(static_cast<Eigen::Index>(rows.size()));
    for (const auto& [row, value] : columns[k]) x(rows.at(row)) = value;
    const double size = x.norm();
    if (size == 0.0) {  // in no equation
      if (sprung && k < 3) out.push_back(k);
      continue;
    }
    for (int again = 0; again < 2; ++again)
      for (const VecX& q : basis) x -= q.dot(x) * q;
    if (x.norm() > 1e-9 * size)
      basis.push_back(x.normalized());
    else
      out.push_back(k);
  }
  return out;
}

}  // namespace

CalculixEquations::CalculixEquations(CalculixText& deck)
    : deck_(deck),
      table_(dof_table(deck.model)),
      dependences_(resolve_dependences(deck.model, table_)),
      place_(static_cast<std::size_t>(table_.size())) {
  deck.dofs = std::count(dependences_.dependent.begin(), dependences_.dependent.end(), 0);
  if (!dependences_.any && deck.model.springs.empty()) return;
  const std::vector<int> rotations = add_rotation_nodes(deck, table_);
  knots_ = knots_of(deck);
  for (int n = 0; n < deck.model.nodes(); ++n)
    for (int axis = 0; axis < table_.count(n); ++axis) {
      const int turned = axis < 3 ? 0 : rotations[n];
      place_[table_.index(n, axis)] =
          turned > 0 ? std::pair{turned, axis - 2} : std::pair{deck.node(n), axis + 1};
    }
}

void CalculixEquations::add_dependences() {
  // All motions of nodes of elements have stiffness or mass.
  const std::vector<char> in_elements =
      nodes_of_elements(deck_.model, [](const FeElement&) { return true; });
  std::vector<std::string> held;
  for (int node = 0; node < deck_.model.nodes(); ++node)
    for (int axis = 0; axis < table_.count(node); ++axis) {
      const int dof = table_.index(node, axis);
      if (dependences_.dependent[dof] == 0) continue;
      add(place_[dof], dependences_.terms[dof], source_of_tie(deck_.model, node));
      if (dependences_.terms[dof].empty() && in_elements[node] != 0)
        held.push_back(fmt::format("{} {}", deck_.model.node_label(node), node_dof_names[axis]));
    }
  note_directions(
      "{} held by equations of the model, written as *BOUNDARY: the part is not free; first: {}",
      held);
  note_not_rigid(in_elements);
  hold_idle_motions(in_elements);
}

void CalculixEquations::note_not_rigid(const std::vector<char>& in_elements) const {
  if (!dependences_.any) return;
  const FeModel& model = deck_.model;
  Eigen::AlignedBox3d box;
  for (const Vec3& p : model.positions) box.extend(p);
  const double size = std::max(0.5 * box.diagonal().norm(), 1e-300);
  std::vector<Vec6> motion(place_.size());  // of each degree of freedom in the rigid ones
  std::vector<std::string> names;
  for (int node = 0; node < model.nodes(); ++node) {
    const Vec3 p = model.positions[node] - box.center();
    for (int axis = 0; axis < table_.count(node); ++axis) {
      Vec6 row = rigid_motion_at(p).row(axis);
      row.tail<3>() /= size;
      motion[table_.index(node, axis)] = row;
    }
  }
  for (int node = 0; node < model.nodes(); ++node)
    for (int axis = 0; axis < table_.count(node); ++axis) {
      const int dof = table_.index(node, axis);
      if (dependences_.dependent[dof] == 0 || dependences_.terms[dof].empty() ||
          in_elements[node] == 0)
        continue;
      Vec6 off = motion[dof];
      double largest = off.cwiseAbs().maxCoeff();
      for (const auto& [other, factor] : dependences_.terms[dof]) {
        const Vec6 term = factor * motion[other];
        largest = std::max(largest, term.cwiseAbs().maxCoeff());
        off -= term;
      }
      if (off.cwiseAbs().maxCoeff() > 1e-6 * largest)
        names.push_back(fmt::format("{} {}", model.node_label(node), node_dof_names[axis]));
    }
  note_directions(
      "{} bound by equations of the model that rigid motions do not satisfy: the part is not free; "
      "first: {}",
      names);
}

void CalculixEquations::note_directions(fmt::format_string<std::string, const std::string&> text,
                                        const std::vector<std::string>& names) const {
  if (!names.empty())
    deck_.note(text, plural(static_cast<long>(names.size()), "direction is", "directions are"),
               names.front());
}

void CalculixEquations::hold_idle_motions(const std::vector<char>& in_elements) {
  if (!dependences_.any) return;
  std::vector<int> node_of(place_.size(), -1);
  for (int n = 0; n < deck_.model.nodes(); ++n)
    if (in_elements[n] == 0 && table_.count(n) == 6)
      std::fill_n(node_of.begin() + table_.begin[n], 6, n);
  NodeColumns columns;
  const auto rows = static_cast<int>(place_.size());
  for (int row = 0; row < rows; ++row)
    for (const auto& [dof, factor] : dependences_.terms[row])
      if (const int n = node_of[dof]; n >= 0) columns[n][dof - table_.begin[n]][row] = factor;
  add_masses_and_springs(deck_.model, in_elements, rows, columns);
  std::set<int> sprung;
  for (const Spring& s : deck_.model.springs) sprung.insert(s.nodes.begin(), s.nodes.end());
  std::vector<std::string> held;
  for (const auto& [node, of_node] : columns)
    for (const std::size_t axis : repeated_columns(of_node, sprung.contains(node))) {
      const int dof = table_.index(node, static_cast<int>(axis));
      if (dof < 0 || dependences_.dependent[dof] != 0) continue;
      add(place_[dof], {}, {});
      held.push_back(fmt::format("{} {}", deck_.model.node_label(node), node_dof_names[axis]));
    }
  deck_.dofs -= static_cast<long>(held.size());
  note_directions(
      "{} held of nodes without elements: what shows that motion does not tell it from others of "
      "the node, and CalculiX finds wrong frequencies if all are free; first: {}",
      held);
}

void CalculixEquations::add(const std::pair<int, int>& place, const Terms& terms,
                            const FeSource& source) {
  const auto& [node, axis] = place;
  if (terms.empty()) {
    zeros_ += fmt::format("{}, {}, {}\n", node, axis, axis);
    return;
  }
  if (axis > 3) refuse(node, source);
  deck_.add("*EQUATION\n{}\n{}, {}, -1", terms.size() + 1, node, axis);
  int in_line = 1;
  for (const auto& [other, factor] : terms) {
    const auto& [there, direction] = place_[other];
    if (direction > 3) refuse(there, source);
    deck_.text += in_line++ % 4 == 0 ? ",\n" : ", ";
    deck_.add("{}, {}, {}", there, direction, calculix_number(factor));
  }
  deck_.text += '\n';
}

std::pair<int, int> CalculixEquations::place(int node, int axis, const FeSource& source) {
  const std::pair<int, int> place = place_[table_.index(node, axis)];
  if (place.second > 3) refuse(place.first, source);
  return place;
}

bool CalculixEquations::is_turn_of_knot(int node, int axis) const {
  const auto& [number, direction] = place_[table_.index(node, axis)];
  return direction > 3 && knots_.contains(number);
}

void CalculixEquations::refuse(int node, const FeSource& source) {
  if (knots_.contains(node)) return;
  if (!refused_.insert(node).second || refused_.size() > 1) return;
  first_refused_ = node;
  first_source_ = source;
}

void CalculixEquations::say_refused() {
  if (refused_.empty()) return;
  const auto more = static_cast<long>(refused_.size()) - 1;
  deck_.error(
      first_source_,
      "the rotation of node {}, of a beam or shell, is in an equation, a spring or the arm of an "
      "end away from its node; CalculiX, which makes solids of beams and shells, would lose it "
      "(.vtu "
      "and .msh show the mesh){}",
      first_refused_,
      more == 0 ? "" : "; the same holds for " + plural(more, "more node", "more nodes"));
}

void CalculixEquations::add_zeros() {
  if (!zeros_.empty()) deck_.text += "*BOUNDARY\n" + zeros_;
}

CalculixEquations::Terms CalculixEquations::independent(int node, const Vec6& factors) const {
  std::map<int, double> sum;
  for (int axis = 0; axis < 6; ++axis) {
    const int dof = table_.index(node, axis);
    if (factors(axis) == 0.0 || dof < 0) continue;
    if (dependences_.dependent[dof] == 0) sum[dof] += factors(axis);
    for (const auto& [other, factor] : dependences_.terms[dof])
      sum[other] += factors(axis) * factor;
  }
  Terms out;
  for (const auto& [dof, factor] : sum)
    if (factor != 0.0) out.emplace_back(dof, factor);
  return out;
}

}  // namespace floatframe
