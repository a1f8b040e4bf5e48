#include "floatframe/model/element_keys.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

namespace {

bool is_zero(const PiecewisePolynomial& f) {
  for (const PiecewisePolynomial::Piece& p : f.pieces())
    for (const double c : p.coefficients)
      if (c != 0.0) return false;
  return true;
}

template <class T>
T value_or(const std::optional<KeyValue>& value, T otherwise) {
  const T* found = value ? std::get_if<T>(&*value) : nullptr;
  return found ? *found : std::move(otherwise);
}

}  // namespace

std::span<const ElementKey> element_keys(ElementType type) noexcept {
  return element_kind(type).keys;
}

std::optional<KeyValue> key_value(const ElementDescription& element, const ElementKey& key) {
  return key.member.read ? key.member.read(element) : std::nullopt;
}

void set_key_value(ElementDescription& element, const ElementKey& key, const KeyValue& value) {
  key.member.write(element, value);
}

const ElementKey& ElementView::key(const std::string& name) const {
  const auto keys = element_keys(force_->type());
  const auto it = std::find_if(keys.begin(), keys.end(), [&](const ElementKey& k) {
    return std::string_view(k.name) == name;
  });
  assert(it != keys.end());
  return *it;
}

AttachmentDescription ElementView::place(const std::string& name) const {
  return value_or(key_value(*force_, key(name)), AttachmentDescription());
}

std::string ElementView::text(const std::string& name) const {
  return value_or(key_value(*force_, key(name)), std::string());
}

Vec3 ElementView::direction(const std::string& name) const {
  const ElementKey& k = key(name);
  return value_or(key_value(*force_, k), Vec3(k.vector[0], k.vector[1], k.vector[2]));
}

double ElementView::number(const std::string& name) const {
  const ElementKey& k = key(name);
  return value_or(key_value(*force_, k), k.fallback);
}

int ElementView::word(const std::string& name) const {
  const ElementKey& k = key(name);
  return value_or(key_value(*force_, k), static_cast<int>(k.fallback));
}

bool ElementView::flag(const std::string& name) const {
  return value_or(key_value(*force_, key(name)), false);
}

PiecewisePolynomial ElementView::law(const std::string& name) const {
  return value_or(key_value(*force_, key(name)), PiecewisePolynomial());
}

std::optional<SignalDescription> ElementView::signal(const std::string& name) const {
  const auto value = key_value(*force_, key(name));
  const auto* found = value ? std::get_if<SignalDescription>(&*value) : nullptr;
  if (const auto* f = value ? std::get_if<TimeFunction>(&*value) : nullptr)
    return SignalDescription(*f);
  return found ? std::optional(*found) : std::nullopt;
}

MatX ElementView::matrix(const std::string& name) const {
  return value_or(key_value(*force_, key(name)), MatX());
}

CoordinateTerm ElementView::coordinate(const std::string& name) const {
  return value_or(key_value(*force_, key(name)), CoordinateTerm());
}

std::vector<CoordinateTerm> ElementView::coordinates() const {
  std::vector<CoordinateTerm> all;
  for (const ElementKey& key : element_keys(force_->type())) {
    const auto value = key_value(*force_, key);
    if (key.kind == KeyKind::joint && value) all.push_back({std::get<std::string>(*value)});
    if (key.kind == KeyKind::own_coordinate && value && !all.empty())
      all.back().coordinate = std::get<int>(*value);
    if (const auto* terms = value ? std::get_if<std::vector<CoordinateTerm>>(&*value) : nullptr)
      all.insert(all.end(), terms->begin(), terms->end());
    if (const auto* term = value ? std::get_if<CoordinateTerm>(&*value) : nullptr)
      all.push_back(*term);
  }
  return all;
}

bool ElementCheck::given(const std::string& key) const {
  if (description().origin.keys.contains(key)) return true;
  const auto value = key_value(description(), this->key(key));
  if (this->key(key).kind == KeyKind::own_coordinate) return std::get<int>(*value) >= 0;
  const auto* law = value ? std::get_if<PiecewisePolynomial>(&*value) : nullptr;
  if (const auto* matrix = value ? std::get_if<MatX>(&*value) : nullptr)
    return !matrix->isZero(0.0);
  return law ? !is_zero(*law) : value.has_value();
}

bool ElementCheck::two_bodies(const std::string& a, const std::string& b) const {
  if (!good(a) || !good(b)) return false;
  const std::string body = place(a).body;
  if (body != place(b).body) return true;
  error(ErrorCode::geometry, "", sentences::both_ends_on(written(body)));
  return false;
}

void ElementCheck::some_law() const {
  std::vector<const char*> laws;
  for (const ElementKey& k : element_keys(description().type())) {
    const bool law = k.kind == KeyKind::spring || k.kind == KeyKind::damper ||
                     k.kind == KeyKind::bump_stop || k.kind == KeyKind::rebound_stop ||
                     k.kind == KeyKind::load || k.kind == KeyKind::stiffness_matrix ||
                     k.kind == KeyKind::damping_matrix || k.kind == KeyKind::speed_table ||
                     k.kind == KeyKind::table;
    if (!law) continue;
    if (given(k.name)) return;
    laws.push_back(k.name);
  }
  error(ErrorCode::missing, "", sentences::no_law(laws));
}

}  // namespace floatframe
