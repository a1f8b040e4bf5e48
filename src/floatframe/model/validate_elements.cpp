// Force elements, by the tables of their keys and the checks of their types, and roads.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "floatframe/core/suggest.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/validate_model.hpp"
#include "floatframe/roads/height_formula.hpp"

namespace floatframe::validation {

namespace {

struct ElementValidation {
  const ModelDescription& d;
  const Names& names;
  const Entity& entity;
  const ElementDescription& force;

  /// True if the value itself is valid.
  bool value(const ElementKey& key) const {
    using K = KeyKind;
    const auto x = key_value(force, key);
    if (!x) {
      if (key.required)
        entity.error(ErrorCode::missing, std::string("missing key '") + key.name + "'");
      return !key.required;
    }
    const std::size_t before = entity.errors.size();
    switch (key.kind) {
      case K::place:
        entity.place(key.name, std::get<AttachmentDescription>(*x), names);
        break;
      case K::own_place:
        entity.place("", std::get<AttachmentDescription>(*x), names, false);
        break;
      case K::joint:
        entity.reference(key.name, "joint", std::get<std::string>(*x), names.joints);
        break;
      case K::road:
        road(key, std::get<std::string>(*x));
        break;
      case K::direction:
      case K::vector:
        entity.direction(key.name, std::get<Vec3>(*x));
        break;
      case K::number:
        entity.number(key.name, std::get<double>(*x), key.rule);
        break;
      case K::word:
        entity.complain(ErrorCode::out_of_range, key.name,
                        word_complaint(std::get<int>(*x), key.words));
        break;
      case K::spring:
      case K::damper:
        entity.pieces(key.name, std::get<PiecewisePolynomial>(*x));
        break;
      case K::stiffness_matrix:
      case K::damping_matrix:
      case K::speed_table:
      case K::table:
      case K::matrix:
      case K::numbers:
      case K::points:
        matrix(key, std::get<MatX>(*x));
        break;
      case K::load:
      case K::target:
      case K::target_rate:
        signal(key.name, std::get<SignalDescription>(*x));
        break;
      case K::signals:
        signals(key, std::get<std::vector<SignalDescription>>(*x));
        break;
      case K::motion:
        entity.function(key.name, std::get<TimeFunction>(*x));
        break;
      case K::terms:
        terms(key.name, std::get<std::vector<CoordinateTerm>>(*x));
        break;
      case K::coordinate:
        entity.reference(key.name, "joint", std::get<CoordinateTerm>(*x).joint, names.joints);
        break;
      case K::function:
        program(key, std::get<ForceFunction>(*x));
        break;
      case K::shape:
      case K::formula:
        formula(key, std::get<SharedFormula>(*x));
        break;
      default:  // flags, stops, names and files
        break;
    }
    return entity.errors.size() == before;
  }

  void program(const ElementKey& key, const ForceFunction& f) const {
    if (!f)
      entity.error(ErrorCode::unsupported, key.name,
                   sentences::function_in_file("'" + f.identity() + "'"));
  }

  /// A kind that feels the profile alone does not roll on a road with width.
  void road(const ElementKey& key, const std::string& of) const {
    if (!entity.reference(key.name, "road", of, names.roads)) return;
    const RoadDescription& r = d.roads[*names.roads.find(of)];
    const char* type = element_type_name(force.type());
    if (element_kind(force.type()).profile_only && r.surface && r.surface->wide())
      entity.error(ErrorCode::unsupported, key.name, sentences::road_with_width(of, type));
  }

  /// Of a shape: of its variable alone.
  void formula(const ElementKey& key, const SharedFormula& f) const {
    if (!f)
      entity.error(ErrorCode::missing, key.name, sentences::missing_formula());
    else if (key.kind == KeyKind::shape)
      entity.complain(ErrorCode::not_found, key.name, sentences::formula_of_one(*f, key.words[0]));
  }

  void signal(const std::string& path, const SignalDescription& s) const {
    entity.signal(path, s, names);
    const bool of_controller = s.source == SignalSource::controller;
    if (of_controller || s.source == SignalSource::force)
      if (const auto k = (of_controller ? names.controllers : names.forces).find(s.element)) {
        const std::vector<std::string> values =
            value_names((of_controller ? d.controllers : d.forces)[*k].kind);
        if (value_index(values, s.value) < 0)
          entity.error(ErrorCode::not_found, path, sentences::no_such_value(s.value, values));
      }
    const auto k = s.source == SignalSource::none || s.source == SignalSource::controller
                       ? std::nullopt
                       : names.forces.find(s.element);
    if (k && !element_has(d.forces[*k].type(), quantity_of(s.source)))
      entity.error(ErrorCode::wrong_value, path,
                   sentences::element_without(element_type_name(d.forces[*k].type()), s.source));
  }

  void terms(const std::string& key, const std::vector<CoordinateTerm>& all) const {
    int number = 0;
    for (const CoordinateTerm& term : all) {
      const std::string path = key + "[" + std::to_string(++number) + "].";
      entity.reference(path + "joint", "joint", term.joint, names.joints);
      entity.number(path + "factor", term.factor, any_number(""));
    }
  }

  void signals(const ElementKey& key, const std::vector<SignalDescription>& all) const {
    for (std::size_t i = 0; i < all.size(); ++i)
      signal(std::string(key.name) + "[" + std::to_string(i + 1) + "]", all[i]);
  }

  void matrix(const ElementKey& key, const MatX& M) const {
    if (key.kind == KeyKind::table && (M.rows() == 0 || M.cols() != std::ssize(key.words)))
      return entity.error(ErrorCode::wrong_count, key.name,
                          sentences::table_rows(M.rows(), M.cols(), key.words));
    const bool numbers = key.kind == KeyKind::numbers, points = key.kind == KeyKind::points;
    if (points && M.size() > 0 && M.cols() != std::ssize(key.words))
      return entity.error(ErrorCode::wrong_count, key.name,
                          sentences::table_rows(M.rows(), M.cols(), key.words));
    if ((key.kind == KeyKind::matrix || numbers) && key.required && M.size() == 0)
      return entity.error(ErrorCode::missing, std::string("missing key '") + key.name + "'");
    if (numbers && M.size() > 0 && (M.rows() != 1 || M.cols() != std::ssize(key.words)))
      return entity.error(ErrorCode::wrong_count, key.name,
                          "found " + std::to_string(M.size()) + " numbers, expected " +
                              std::to_string(key.words.size()));
    if (key.kind == KeyKind::table || key.kind == KeyKind::matrix || numbers || points) {
      for (Eigen::Index i = 0; i < M.size(); ++i) entity.number(key.name, M(i), key.rule);
    } else if (M.size() > 0) {
      entity.complain(ErrorCode::wrong_value, key.name,
                      key.kind == KeyKind::speed_table ? sentences::speed_table(M)
                                                       : sentences::force_matrix(M));
    }
  }

  void all() const {
    ElementCheck check(force);
    for (const ElementKey& key : element_keys(force.type()))
      if (!value(key)) check.wrong.insert(key.name);
    check.from_file = !force.origin.mark.file.empty();
    check.error = [&](ErrorCode code, const std::string& key, const std::string& sentence) {
      key.empty() ? entity.error(code, sentence) : entity.error(code, key, sentence);
    };
    check.written = [](const std::string& name) { return name; };
    check.joint_type = [&](const std::string& joint) -> std::optional<JointType> {
      const auto k = names.joints.find(joint);
      return k ? std::optional(d.joints[*k].type) : std::nullopt;
    };
    if (const auto validate = element_kind(force.type()).validate) validate(check);
  }
};

void road_surface(const RoadSurface& surface, const Entity& entity) {
  if (surface.height)
    if (const std::string why = height_formula_complaint(*surface.height); !why.empty())
      entity.error(ErrorCode::not_found, "height", why);
  entity.number("friction", surface.friction, rules::road_friction);
  for (std::size_t i = 0; i < surface.patches.size(); ++i) {
    const FrictionPatch& p = surface.patches[i];
    const std::string patch = "patches[" + std::to_string(i + 1) + "].";
    entity.number(patch + "friction", p.friction, rules::road_friction);
    for (const auto& [key, low, high] : {std::tuple("x", p.x0, p.x1), std::tuple("y", p.y0, p.y1)})
      if (!(low < high) || !std::isfinite(high - low))
        entity.error(ErrorCode::wrong_value, patch + key, sentences::patch_range(low, high));
  }
}

}  // namespace

void elements(const ModelDescription& d, const Names& names, ErrorList& errors) {
  std::set<std::string> taken;
  for (const ElementList list :
       {ElementList::rods, ElementList::constraints, ElementList::couplings, ElementList::forces,
        ElementList::controllers}) {
    const std::string section = element_list_name(list);
    if (list != ElementList::controllers) taken.clear();  // states are named by both lists
    for (const ElementDescription& e : d.elements(list)) {
      const Entity entity{errors, e.origin, section + "." + e.name};
      name(section.c_str(), e.name, taken, entity);
      if (element_kind(e.type()).list != list)
        entity.error(ErrorCode::wrong_value, "type",
                     sentences::element_of_another_list(element_type_name(e.type())));
      else
        ElementValidation{d, names, entity, e}.all();
    }
  }
}

void roads(const ModelDescription& d, ErrorList& errors) {
  std::set<std::string> taken;
  for (const RoadDescription& r : d.roads) {
    const Entity entity{errors, r.origin, "roads." + r.name};
    name("roads", r.name, taken, entity);
    entity.pieces("profile", r.pieces, true);
    for (std::size_t i = 0; i < r.bumps.size(); ++i) {
      const std::string bump = "bumps[" + std::to_string(i + 1) + "].";
      entity.number(bump + "start", r.bumps[i].start, any_number("m"));
      entity.number(bump + "length", r.bumps[i].length, rules::bump_length);
      entity.number(bump + "height", r.bumps[i].height, any_number("m"));
    }
    if (r.surface) road_surface(*r.surface, entity);
  }
}

}  // namespace floatframe::validation
