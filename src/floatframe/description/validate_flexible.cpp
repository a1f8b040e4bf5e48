// Flexible bodies of bars: material, geometry, body reference, modes.
#include <algorithm>
#include <cmath>
#include <map>

#include "floatframe/core/suggest.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/description/validate.hpp"
#include "floatframe/math/union_find.hpp"

namespace floatframe::validation {

namespace {

class FlexibleCheck {
 public:
  FlexibleCheck(const FlexibleDescription& f, const Entity& body)
      : f_(f), group_{body.errors, body.origin, body.path + ".flexible"} {}

  void run() {
    material();
    const std::size_t before = group_.errors.size();
    points();
    bars();
    geometry_good_ = group_.errors.size() == before;
    masses();
    modes();
  }

 private:
  struct BarGeometry {
    Vec3 from = Vec3::Zero(), to = Vec3::Zero();
    int elements = 1;
    int index = 0;
    bool good = false;
  };

  void material() {
    group_.number("material.young", f_.young, rules::young);
    group_.number("material.poisson", f_.poisson, rules::poisson);
    group_.number("material.density", f_.density, rules::density);
    if (const auto complaint = damping_complaint(f_.damping))
      group_.error(ErrorCode::out_of_range, "damping", *complaint);
    group_.word("mass_model", f_.mass_model, rules::mass_models);
    group_.complain(ErrorCode::contradiction, "section_inertia",
                    sentences::section_inertia(f_.section_inertia, isoparametric()));
  }

  bool isoparametric() const { return f_.mass_model == MassModel::isoparametric; }

  void points() {
    for (const auto& [name, p] : f_.points) {
      known_points_.add(name);
      group_.vector("points." + name, p, "m");
    }
  }

  void section(const Entity& bar, const SectionDescription& s) {
    if (const auto* r = std::get_if<SolidRound>(&s)) {
      bar.number("section.round", r->diameter, rules::section_length);
    } else if (const auto* h = std::get_if<HollowRound>(&s)) {
      const bool good = bar.number("section.tube[1]", h->outer, rules::section_length);
      if (bar.number("section.tube[2]", h->inner, rules::section_length) && good)
        bar.complain(ErrorCode::contradiction, "section.tube", sentences::tube(h->outer, h->inner));
    } else if (const auto* q = std::get_if<Rectangle>(&s)) {
      bar.number("section.rectangle[1]", q->width, rules::section_length);
      bar.number("section.rectangle[2]", q->height, rules::section_length);
    } else if (const auto* c = std::get_if<SectionConstants>(&s)) {
      bar.number("section.area", c->A, rules::section_area);
      bar.number("section.Iy", c->Iy, rules::section_moment);
      bar.number("section.Iz", c->Iz, rules::section_moment);
      bar.number("section.J", c->J, rules::section_moment);
    }
  }

  /// The position of a point; null and an error if the name does not exist.
  const Vec3* point(const Entity& bar, const char* key, const std::string& name) {
    const auto it = f_.points.find(name);
    if (it != f_.points.end()) return &it->second;
    bar.reference(key, "point", name, known_points_);
    return nullptr;
  }

  bool branch(const Entity& bar, const BarDescription& b, BarGeometry& g) {
    const auto it = geometry_.find(*b.from_bar);
    if (it == geometry_.end()) {
      bar.error(ErrorCode::not_found, "from.bar",
                sentences::unknown_bar(*b.from_bar, did_you_mean(*b.from_bar, keys_of(geometry_))));
      return false;
    }
    if (!bar.number("from.at", b.from_fraction, rules::fraction) || !it->second.good) return false;
    const BarGeometry& other = it->second;
    g.from = other.from + (other.to - other.from) * b.from_fraction;
    return true;  // `build_bar_frame` looks for the node
  }

  void bars() {
    if (f_.bars.empty()) group_.error(ErrorCode::missing, "bars", sentences::no_bars());
    for (const BarDescription& b : f_.bars) {
      const Entity bar{group_.errors, b.origin.mark.file.empty() ? group_.origin : b.origin,
                       group_.path + ".bars." + b.name};
      name((group_.path + ".bars").c_str(), b.name, taken_bars_, bar);
      BarGeometry g;
      g.elements = b.elements;
      g.index = joined_.add();
      g.good = bar.whole("elements", b.elements, rules::elements);
      section(bar, b.section);
      const Vec3* from = nullptr;
      if (b.from_bar)
        g.good = branch(bar, b, g) && g.good;
      else
        from = point(bar, "from", b.from);
      const Vec3* to = point(bar, "to", b.to);
      g.good = g.good && (b.from_bar || from) && to;
      if (from) g.from = *from;
      if (to) g.to = *to;
      const bool directed = bar.vector("reference", b.reference, "");
      g.good = g.good && g.from.allFinite() && g.to.allFinite();
      if (g.good) {
        if (const auto complaint = sentences::bar_length((g.to - g.from).norm())) {
          bar.error(ErrorCode::out_of_range, *complaint);
          g.good = false;
        } else if (directed) {
          if (const auto zero = sentences::direction(b.reference))
            bar.error(ErrorCode::geometry, "reference", *zero);
          else
            bar.complain(ErrorCode::geometry, "reference",
                         sentences::bar_reference(g.to - g.from, b.reference.stableNormalized()));
        }
      }
      if (g.good) {
        join(g.index, b.to);
        if (b.from_bar)
          joined_.join(g.index, geometry_.at(*b.from_bar).index);
        else
          join(g.index, b.from);
        nodes_ += b.elements;
      }
      geometry_[b.name] = g;
    }
    connectivity();
  }

  // Connectivity of the bars.
  void join(int bar, const std::string& point) {
    const auto [it, fresh] = bar_of_point_.emplace(point, bar);
    if (!fresh) joined_.join(bar, it->second);
  }
  void connectivity() {
    for (const auto& [name, g] : geometry_)
      if (!g.good) return;
    for (const BarDescription& b : f_.bars)
      if (joined_.root(geometry_.at(b.name).index) != joined_.root(0)) {
        group_.error(ErrorCode::not_found, "bars." + b.name,
                     sentences::bar_not_connected(f_.bars.front().name));
        return;
      }
  }

  bool node(const std::string& key, const std::string& name) {
    if (bar_of_point_.contains(name)) return true;
    if (!geometry_good_) return false;  // an invalid bar creates no nodes
    group_.error(ErrorCode::not_found, key,
                 sentences::no_end_point(name) + did_you_mean(name, keys_of(bar_of_point_)));
    return false;
  }

  void masses() {
    for (std::size_t i = 0; i < f_.masses.size(); ++i) {
      const std::string key = "masses[" + std::to_string(i + 1) + "].";
      node(key + "point", f_.masses[i].node);
      group_.number(key + "mass", f_.masses[i].mass, rules::mass);
    }
  }

  void dofs(const char* key, const std::vector<NodeDofs>& given,
            std::vector<std::pair<Vec3, unsigned>>* places) {
    for (std::size_t i = 0; i < given.size(); ++i) {
      const NodeDofs& d = given[i];
      const std::string item = std::string(key) + "[" + std::to_string(i + 1) + "]";
      if (d.mask == 0 || d.mask > 63u)
        group_.error(ErrorCode::wrong_value, item + ".dofs",
                     "found the mask " + std::to_string(d.mask) +
                         ", expected directions: bits 0 to 5 = x, y, z, rx, ry, rz");
      if (!node(item + ".point", d.node)) continue;
      for (unsigned k = 0; k < 6; ++k) {
        if (!(d.mask & (1u << k))) continue;
        if (!taken_dofs_.insert({d.node, k}).second)
          group_.error(ErrorCode::duplicate, item, sentences::dof_twice(d.node, k));
        else if (places)
          places->emplace_back(f_.points.at(d.node), k);
      }
    }
  }

  /// Bars of a path, and directions of forces on it.
  void path() {
    for (std::size_t i = 0; i < f_.path.size(); ++i) {
      const NodeDofs& d = f_.path[i];
      const std::string item = "path_shapes[" + std::to_string(i + 1) + "].";
      if (d.mask == 0 || d.mask > 63u)
        group_.error(ErrorCode::wrong_value, item + "dofs",
                     "found the mask " + std::to_string(d.mask) +
                         ", expected directions: bits 0 to 5 = x, y, z, rx, ry, rz");
      if (!geometry_.contains(d.node))
        group_.error(ErrorCode::not_found, item + "bar",
                     "found '" + d.node + "', expected the name of a bar of this body" +
                         did_you_mean(d.node, keys_of(geometry_)));
    }
  }

  void modes() {
    if (f_.analytic) {
      group_.whole("analytic.dynamic_per_plane", f_.analytic->dynamic_per_plane,
                   rules::analytic_shapes);
      group_.complain(ErrorCode::wrong_value, "analytic",
                      sentences::analytic_shapes(f_.bars.size(), f_.masses.size()));
      return;
    }
    if (f_.basis) {
      if (!f_.basis->allFinite())
        group_.error(ErrorCode::not_finite, "basis",
                     "found numbers that are not finite, expected finite ones");
      return;  // its rows are compared with the nodes when the body is reduced
    }
    if (!geometry_good_) return;
    std::vector<std::pair<Vec3, unsigned>> clamped;
    const std::size_t before = group_.errors.size();
    dofs("clamped", f_.clamped, &clamped);
    dofs("static_modes", f_.interfaces, nullptr);
    path();
    const bool selection = group_.errors.size() == before;
    const bool number = group_.whole("normal_modes", f_.normal_modes, rules::normal_modes);
    if (f_.max_frequency != 0.0)
      group_.number("normal_modes.below", f_.max_frequency, rules::mode_frequency);
    if (number)
      group_.complain(
          ErrorCode::out_of_range, "normal_modes",
          sentences::more_modes_than_dofs(f_.normal_modes, nodes_ + 1, isoparametric()));
    if (f_.interfaces.empty() && f_.path.empty() && f_.normal_modes == 0 && f_.max_frequency == 0.0)
      group_.error(ErrorCode::missing, sentences::no_modes());
    if (selection)
      group_.complain(ErrorCode::singular, "clamped", sentences::body_reference(clamped));
  }

  const FlexibleDescription& f_;
  const Entity group_;
  NameIndex known_points_;
  std::map<std::string, BarGeometry> geometry_;
  std::map<std::string, int> bar_of_point_;
  UnionFind joined_;
  std::set<std::string> taken_bars_;
  std::set<std::pair<std::string, unsigned>> taken_dofs_;
  bool geometry_good_ = false;
  std::size_t nodes_ = 0;  // without the first one, if the bars form no loop
};

}  // namespace

void flexible(const FlexibleDescription& f, const Entity& body) { FlexibleCheck(f, body).run(); }

}  // namespace floatframe::validation
