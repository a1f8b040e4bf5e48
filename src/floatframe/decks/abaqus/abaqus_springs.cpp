// Springs of Abaqus and CalculiX decks: SPRINGA (along the line of its nodes), SPRING1 (a direction
// of a node and the ground), SPRING2 (directions of two nodes). Of a table of forces the slope at
// zero elongation counts. Dashpots and gaps have no linear stiffness.
#include <algorithm>
#include <set>

#include "floatframe/decks/abaqus/abaqus_build.hpp"
#include "floatframe/decks/abaqus/abaqus_card.hpp"

namespace floatframe {
namespace {

using Family = AbaqusType::Family;

/// dF/du at u = 0 of a table of (force, elongation): the mean of both sides at a corner.
std::optional<double> slope_at_zero(std::vector<std::pair<double, double>> table) {
  std::sort(table.begin(), table.end(),
            [](const auto& a, const auto& b) { return a.second < b.second; });
  double sum = 0.0;
  int sides = 0;
  for (std::size_t i = 1; i < table.size(); ++i) {
    const auto& [f0, u0] = table[i - 1];
    const auto& [f1, u1] = table[i];
    if (!(u1 > u0)) return std::nullopt;
    if (u0 > 0.0 || u1 < 0.0) continue;
    sum += (f1 - f0) / (u1 - u0);
    ++sides;
  }
  if (sides == 0) return std::nullopt;
  return sum / sides;
}

class AbaqusSpringBuilder {
 public:
  explicit AbaqusSpringBuilder(AbaqusBuild& build) : b_(build), c_(build.content) {}

  void build() {
    std::vector<int> spring_of(c_.elements.size(), -1);
    for (std::size_t s = 0; s < c_.springs.size(); ++s) {
      for (const int e : b_.elements.resolve(c_.springs[s].where)) {
        if (c_.elements[e].type->family != Family::spring) {
          b_.source.error(ErrorCode::wrong_value, c_.springs[s].where.at,
                          "*SPRING names {}, which is no spring", abaqus_label(c_.elements[e]));
          break;
        }
        spring_of[e] = static_cast<int>(s);
      }
    }
    for (std::size_t e = 0; e < c_.elements.size(); ++e) {
      const AbaqusElement& element = c_.elements[e];
      const Family family = element.type->family;
      if (family == Family::damper) ++dampers_;
      if (family != Family::spring) continue;
      if (spring_of[e] < 0)
        b_.error(element, ErrorCode::missing, " has no *SPRING");
      else
        one(element, c_.springs[spring_of[e]]);
    }
    if (dampers_ > 0)
      b_.note({0, 1}, "{} dashpots are ignored, the part has modal damping (--damping)", dampers_);
  }

 private:
  bool nodes_of(const AbaqusElement& e, std::array<int, 2>& out) {
    out = {-1, -1};
    for (int k = 0; k < e.type->nodes; ++k) {
      const int node = b_.node_of(e, k);
      if (node < 0) return false;
      for (const Spider& s : b_.model.spiders) {
        if (s.rotation_node != node) continue;
        b_.error(e, ErrorCode::unsupported,
                 ": node {} carries the rotations of a rigid body, where springs are not "
                 "supported",
                 c_.element_nodes[e.first + k]);
        return false;
      }
      out[k] = node;
    }
    return true;
  }

  /// Directions that its degrees of freedom count in. *TRANSFORM turns those of equations and
  /// supports, not of springs.
  Mat3 axes_of(int node, const AbaqusSpring& spring) {
    if (spring.orientation.empty()) return Mat3::Identity();
    AbaqusSection user;  // for the messages
    user.shown = "*SPRING";
    user.where = spring.where;
    const int index = abaqus_orientation(b_, spring.orientation, user);
    return index < 0 ? Mat3(Mat3::Identity())
                     : b_.model.orientations[index].at(b_.model.positions[node]);
  }

  void one(const AbaqusElement& e, const AbaqusSpring& raw) {
    Spring spring;
    if (!nodes_of(e, spring.nodes)) return;
    spring.name = abaqus_label(e);
    spring.source = e.at;
    const bool along = e.type->name == "SPRINGA";
    const auto k = stiffness(e, raw, along ? 0 : 1);
    if (!k) return;
    spring.stiffness = *k;
    if (along) {
      const Vec3 d = b_.model.positions[spring.nodes[1]] - b_.model.positions[spring.nodes[0]];
      if (!(d.norm() > 0.0))
        return b_.error(e, ErrorCode::geometry,
                        ": its nodes are at one place, so it has no direction; use SPRING2");
      spring.directions[0].head<3>() = -d.normalized();
      spring.directions[1].head<3>() = d.normalized();
    } else {
      for (int end = 0; end < e.type->nodes; ++end) {
        const std::vector<double>& dofs = raw.lines.front();
        const double dof = static_cast<std::size_t>(end) < dofs.size() ? dofs[end] : 0.0;
        if (!(dof >= 1.0 && dof <= 6.0) || dof != static_cast<int>(dof))
          return b_.source.error(
              ErrorCode::out_of_range, raw.where.at,
              "*SPRING: direction {} of {} is {:g}, expected one of 1 to 6 in its first line",
              end + 1, e.type->name, dof);
        const int axis = static_cast<int>(dof) - 1;
        const Vec3 t = axes_of(spring.nodes[end], raw).col(axis % 3);
        spring.directions[end].segment<3>(axis < 3 ? 0 : 3) = end == 0 ? Vec3(-t) : t;
      }
    }
    if (spring.stiffness != 0.0) b_.model.springs.push_back(std::move(spring));
  }

  /// The constants begin in a line.
  std::optional<double> stiffness(const AbaqusElement& e, const AbaqusSpring& raw,
                                  std::size_t first) {
    if (raw.lines.size() <= first) {
      b_.source.error(ErrorCode::incomplete, raw.where.at, "*SPRING: {} needs {}", abaqus_label(e),
                      first == 0 ? "a line with its stiffness"
                                 : "a line with its directions and one with its stiffness");
      return std::nullopt;
    }
    if (!raw.nonlinear) {
      if (raw.lines.size() > first + 1 && noted_.insert(&raw).second)
        b_.note(raw.where.at, "*SPRING depends on temperature: its first stiffness is taken");
      return raw.lines[first].front();
    }
    std::vector<std::pair<double, double>> table;
    for (std::size_t i = first; i < raw.lines.size(); ++i)
      table.emplace_back(raw.lines[i].front(), raw.lines[i].size() > 1 ? raw.lines[i][1] : 0.0);
    const auto k = slope_at_zero(table);
    if (!k) {
      b_.source.error(
          ErrorCode::contradiction, raw.where.at,
          "*SPRING has a table that does not show its stiffness at zero elongation: expected lines "
          "of force and elongation, with different elongations on both sides of zero");
      return std::nullopt;
    }
    if (noted_.insert(&raw).second)
      b_.note(raw.where.at,
              "*SPRING is not linear: its stiffness at zero elongation, {:g}, is taken", *k);
    return k;
  }

  AbaqusBuild& b_;
  const AbaqusContent& c_;
  std::set<const AbaqusSpring*> noted_;
  int dampers_ = 0;
};

}  // namespace

void read_abaqus_spring(AbaqusCard& card) {
  AbaqusSpring spring;
  spring.nonlinear = card.has("NONLINEAR");
  spring.orientation = card.word("ORIENTATION");
  const bool named = !card.required("ELSET").empty();
  while (card.next()) {  // blank lines are none
    std::vector<double> numbers;
    for (std::size_t k = 0; k < card.fields.size() && k < 3; ++k)
      numbers.push_back(card.real_or(k, 0.0, "*SPRING"));
    spring.lines.push_back(std::move(numbers));
  }
  AbaqusContent& content = card.content;
  if (content.only_nodes || !named) return;
  spring.where = {0, 0, 1, content.intern(card.word("ELSET")), content.scope, card.at};
  content.springs.push_back(std::move(spring));
}

void build_abaqus_springs(AbaqusBuild& build) { AbaqusSpringBuilder(build).build(); }

}  // namespace floatframe
