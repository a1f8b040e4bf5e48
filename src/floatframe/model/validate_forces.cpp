// Force elements, by the tables of their keys and the checks of their types, and roads.
#include <algorithm>

#include "floatframe/core/suggest.hpp"
#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/sentences.hpp"
#include "floatframe/model/validate.hpp"

namespace floatframe::validation {

namespace {

/// The expected kind of value; nullptr if it matches.
const char* other_type(const ForceKey& key, const ForceValue& value) {
  using K = ForceKeyKind;
  const auto needs = [&]<class T>(const T*, const char* what) -> const char* {
    return std::holds_alternative<T>(value) ? nullptr : what;
  };
  switch (key.kind) {
    case K::place:
    case K::own_place:
      return needs(static_cast<AttachmentDescription*>(nullptr), "a place");
    case K::joint:
    case K::road:
      return needs(static_cast<std::string*>(nullptr), "a name");
    case K::direction:
    case K::vector:
      return needs(static_cast<Vec3*>(nullptr), "a direction");
    case K::number:
      return needs(static_cast<double*>(nullptr), "a number");
    case K::word:
      return nullptr;  // a word or its index: checked by `word`
    case K::flag:
      return needs(static_cast<bool*>(nullptr), "true or false");
    case K::spring:
    case K::damper:
      return needs(static_cast<PiecewisePolynomial*>(nullptr), "a law");
    case K::stiffness_matrix:
    case K::damping_matrix:
    case K::speed_table:
      return needs(static_cast<MatX*>(nullptr), "a matrix");
    case K::bump_stop:
    case K::rebound_stop:
      return "a ramp in the spring";
    default:
      return needs(static_cast<SignalDescription*>(nullptr), "a signal");
  }
}

struct ForceValidation {
  const ModelDescription& d;
  const Names& names;
  const Entity& entity;
  const ForceDescription& force;

  bool word(const ForceKey& key, const ForceValue& value) const {
    const int* k = std::get_if<int>(&value);
    const auto* text = std::get_if<std::string>(&value);
    auto complaint = word_complaint(k ? *k : -1, key.words);
    if (text) complaint = "found '" + *text + "', expected " + alternatives(key.words);
    entity.complain(ErrorCode::out_of_range, key.name, complaint);
    return !complaint;
  }

  /// True if the value itself is valid.
  bool value(const ForceKey& key) const {
    using K = ForceKeyKind;
    const auto x = force_value(force, key);
    if (!x) {
      if (key.required)
        entity.error(ErrorCode::missing, std::string("missing key '") + key.name + "'");
      return !key.required;
    }
    if (const char* what = other_type(key, *x)) {
      entity.error(ErrorCode::wrong_value, key.name,
                   std::string("found a value of another type, expected ") + what);
      return false;
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
        entity.reference(key.name, "road", std::get<std::string>(*x), names.roads);
        break;
      case K::direction:
      case K::vector:
        entity.direction(key.name, std::get<Vec3>(*x));
        break;
      case K::number:
        entity.number(key.name, std::get<double>(*x), key.rule);
        break;
      case K::word:
        word(key, *x);
        break;
      case K::spring:
      case K::damper:
        entity.pieces(key.name, std::get<PiecewisePolynomial>(*x));
        break;
      case K::stiffness_matrix:
      case K::damping_matrix:
        entity.complain(ErrorCode::wrong_value, key.name,
                        sentences::force_matrix(std::get<MatX>(*x)));
        break;
      case K::speed_table:
        entity.complain(ErrorCode::wrong_value, key.name,
                        sentences::speed_table(std::get<MatX>(*x)));
        break;
      case K::load:
      case K::target:
      case K::target_rate:
        entity.signal(key.name, std::get<SignalDescription>(*x), names);
        break;
      case K::flag:
      case K::bump_stop:
      case K::rebound_stop:
        break;
    }
    return entity.errors.size() == before;
  }

  void unknown_keys() const {
    const auto* by_key = std::get_if<ForceValues>(&force.kind);
    if (!by_key) return;
    std::vector<std::string> known;
    for (const ForceKey& key : force_keys(force.type())) known.push_back(key.name);
    for (const auto& [key, value] : by_key->values)
      if (std::find(known.begin(), known.end(), key) == known.end())
        entity.error(ErrorCode::unknown_key,
                     "unknown key '" + key + "'" + did_you_mean(key, known));
  }

  void all() const {
    if (const auto complaint = word_complaint(static_cast<int>(force.type()), force_words)) {
      entity.error(ErrorCode::wrong_value, "type", *complaint);
      return;
    }
    unknown_keys();
    ForceCheck check(force);
    for (const ForceKey& key : force_keys(force.type()))
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
    if (const auto validate = force_kind(force.type()).validate) validate(check);
  }
};

}  // namespace

void forces(const ModelDescription& d, const Names& names, ErrorList& errors) {
  std::set<std::string> taken;
  for (const ForceDescription& f : d.forces) {
    const Entity entity{errors, f.origin, "forces." + f.name};
    name("forces", f.name, taken, entity);
    ForceValidation{d, names, entity, f}.all();
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
  }
}

}  // namespace floatframe::validation
