#include "floatframe/decks/calculix/calculix_knots.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/fe/beam_tangent.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"

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
  const Element& e = model.elements[element];
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

/// Does CalculiX make other nodes of it than of `first`? Of round sections it may not tell pipes.
bool is_apart(const BeamEnd& e, const BeamEnd& first) {
  const auto differ = [](const std::array<double, 2>& a, const std::array<double, 2>& b) {
    return std::abs(a[0] - b[0]) > 1e-9 || std::abs(a[1] - b[1]) > 1e-9;
  };
  return !(e.tangent.dot(first.tangent) > within_20_degrees) ||
         !(e.normal.dot(first.normal) > within_20_degrees) ||
         differ(e.thickness, first.thickness) || differ(e.offset, first.offset) ||
         e.rectangle != first.rectangle;
}

}  // namespace

std::set<int> calculix_knots(const CalculixText& deck) {
  const FeModel& model = deck.model;
  std::map<int, std::vector<BeamEnd>> ends;  // by nodes
  std::set<int> others;
  for (std::size_t i = 0; i < model.elements.size(); ++i) {
    const Element& e = model.elements[i];
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

}  // namespace floatframe
