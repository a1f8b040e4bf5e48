#include "floatframe/model/force_keys.hpp"

#include <algorithm>
#include <cassert>
#include <string_view>

#include "floatframe/model/force_kind.hpp"
#include "floatframe/model/sentences.hpp"

namespace floatframe {

namespace {

bool is_zero(const PiecewisePolynomial& f) {
  for (const PiecewisePolynomial::Piece& p : f.pieces())
    for (const double c : p.coefficients)
      if (c != 0.0) return false;
  return true;
}

template <class T>
T value_or(const std::optional<ForceValue>& value, T otherwise) {
  const T* found = value ? std::get_if<T>(&*value) : nullptr;
  return found ? *found : std::move(otherwise);
}

}  // namespace

std::span<const ForceKey> force_keys(ForceType type) noexcept { return force_kind(type).keys; }

std::optional<ForceValue> force_value(const ForceDescription& force, const ForceKey& key) {
  const auto* by_key = std::get_if<ForceValues>(&force.kind);
  if (!by_key) return key.member.read ? key.member.read(force) : std::nullopt;
  const auto it = by_key->values.find(key.name);
  if (it == by_key->values.end()) return std::nullopt;
  if (const int* n = std::get_if<int>(&it->second); n && key.kind == ForceKeyKind::number)
    return ForceValue(static_cast<double>(*n));
  if (const auto* word = std::get_if<std::string>(&it->second);
      word && key.kind == ForceKeyKind::word)
    for (std::size_t k = 0; k < key.words.size(); ++k)
      if (*word == key.words[k]) return ForceValue(static_cast<int>(k));
  return it->second;
}

void set_force_value(ForceDescription& force, const ForceKey& key, const ForceValue& value) {
  if (auto* by_key = std::get_if<ForceValues>(&force.kind))
    by_key->values.insert_or_assign(key.name, value);
  else
    key.member.write(force, value);
}

const ForceKey& ForceView::key(const std::string& name) const {
  const auto keys = force_keys(force_->type());
  const auto it = std::find_if(keys.begin(), keys.end(),
                               [&](const ForceKey& k) { return std::string_view(k.name) == name; });
  assert(it != keys.end());
  return *it;
}

AttachmentDescription ForceView::place(const std::string& name) const {
  return value_or(force_value(*force_, key(name)), AttachmentDescription());
}

std::string ForceView::text(const std::string& name) const {
  return value_or(force_value(*force_, key(name)), std::string());
}

Vec3 ForceView::direction(const std::string& name) const {
  const ForceKey& k = key(name);
  return value_or(force_value(*force_, k), Vec3(k.vector[0], k.vector[1], k.vector[2]));
}

double ForceView::number(const std::string& name) const {
  const ForceKey& k = key(name);
  return value_or(force_value(*force_, k), k.fallback);
}

int ForceView::word(const std::string& name) const {
  const ForceKey& k = key(name);
  return value_or(force_value(*force_, k), static_cast<int>(k.fallback));
}

bool ForceView::flag(const std::string& name) const {
  return value_or(force_value(*force_, key(name)), false);
}

PiecewisePolynomial ForceView::law(const std::string& name) const {
  return value_or(force_value(*force_, key(name)), PiecewisePolynomial());
}

std::optional<SignalDescription> ForceView::signal(const std::string& name) const {
  const auto value = force_value(*force_, key(name));
  const auto* found = value ? std::get_if<SignalDescription>(&*value) : nullptr;
  return found ? std::optional(*found) : std::nullopt;
}

MatX ForceView::matrix(const std::string& name) const {
  return value_or(force_value(*force_, key(name)), MatX());
}

bool ForceCheck::given(const std::string& key) const {
  if (description().origin.keys.contains(key)) return true;
  const auto value = force_value(description(), this->key(key));
  const auto* law = value ? std::get_if<PiecewisePolynomial>(&*value) : nullptr;
  if (const auto* matrix = value ? std::get_if<MatX>(&*value) : nullptr)
    return !matrix->isZero(0.0);
  return law ? !is_zero(*law) : value.has_value();
}

bool ForceCheck::two_bodies(const std::string& a, const std::string& b) const {
  if (!good(a) || !good(b)) return false;
  const std::string body = place(a).body;
  if (body != place(b).body) return true;
  error(ErrorCode::geometry, "", sentences::both_ends_on(written(body)));
  return false;
}

void ForceCheck::some_law() const {
  std::vector<const char*> laws;
  for (const ForceKey& k : force_keys(description().type())) {
    const bool law = k.kind == ForceKeyKind::spring || k.kind == ForceKeyKind::damper ||
                     k.kind == ForceKeyKind::bump_stop || k.kind == ForceKeyKind::rebound_stop ||
                     k.kind == ForceKeyKind::load || k.kind == ForceKeyKind::stiffness_matrix ||
                     k.kind == ForceKeyKind::damping_matrix || k.kind == ForceKeyKind::speed_table;
    if (!law) continue;
    if (given(k.name)) return;
    laws.push_back(k.name);
  }
  error(ErrorCode::missing, "", sentences::no_law(laws));
}

}  // namespace floatframe
