#include "floatframe/page/scene_efforts.hpp"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "floatframe/model/element_outputs.hpp"
#include "floatframe/model/joint_kind.hpp"
#include "floatframe/model/joint_measure.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/system_motion.hpp"
#include "floatframe/page/html_text.hpp"

namespace floatframe {

using Json = nlohmann::ordered_json;

namespace {

/// The port whose wrench is shown: of the anchors that are drawn the second before the first, on a
/// body before the ground. -1: none is on a body.
int shown_port(const Model& model, const Element& e) {
  const Picture picture = picture_of(e);
  std::vector<int> order{picture.b, picture.a};
  if (picture.symbol == Picture::Symbol::wheel) order = {picture.a};
  order.insert(order.end(), e.markers.rbegin(), e.markers.rend());
  for (const int marker : order) {
    if (marker < 0 || model.markers[marker].body < 0) continue;
    for (int k = 0; k < std::ssize(e.markers); ++k)
      if (e.markers[k] == marker) return k;
  }
  return -1;
}

/// The results of an element, in the order of `Efforts::result`, with their names.
struct NamedResult {
  std::string name, unit;
  int result = 0;
};

std::vector<NamedResult> results_of(const Element& e) {
  std::vector<NamedResult> out;
  if (const auto values = values_of_element(*e.keys); !values.empty()) {
    int k = 0;
    for (const ElementValue& v : values) {
      out.push_back({spaced_words(v.name), v.unit, k == 0 ? 0 : k + 2});
      ++k;
    }
  }
  const auto add = [&](ElementQuantity quantity, const char* name, const char* of_angles,
                       int result) {
    if (!element_has(e.type, quantity)) return;
    const std::string unit = element_output_unit(e, quantity);
    const bool about = unit == "N m" || unit.starts_with("rad");
    out.push_back({about ? of_angles : name, unit, result});
  };
  if (out.empty()) add(ElementQuantity::force, "force", "torque", 0);
  add(ElementQuantity::length, "length", "angle", 1);
  add(ElementQuantity::rate, "rate", "rate", 2);
  for (NamedResult& r : out)
    if (r.unit == "-") r.unit.clear();
  return out;
}

}  // namespace

EffortCollector::EffortCollector(const Model& model) : model_(model) {
  const auto value = [&](std::string name, std::string unit) {
    return SceneEfforts::Value{std::move(name), std::move(unit), out_.columns++};
  };
  for (const Element& e : model.elements) {
    SceneEfforts::OfElement& of = out_.elements.emplace_back();
    if (!e.exerts()) continue;
    of.port = shown_port(model, e);
    if (of.port >= 0) {
      of.wrench = out_.columns;
      out_.columns += 6;
    }
    for (NamedResult& r : results_of(e)) {
      of.values.push_back(value(std::move(r.name), std::move(r.unit)));
      results_.push_back(r.result);
    }
  }
  for (int i = 0; i < std::ssize(model.joints); ++i) {
    const Joint& j = model.joints[i];
    std::vector<SceneEfforts::Value>& of = out_.joints.emplace_back();
    const JointKind& kind = joint_kind(j.type);
    if (j.automatic || kind.coordinates.count() == 6) continue;
    for (int c = 0; c < kind.coordinates.count(); ++c) {
      followed_.push_back({.joint = i, .component = c});
      const std::string of_several = " " + spaced_words(kind.coordinates.all()[c].name);
      const auto named = [&](const std::string& quantity) {
        return kind.coordinates.count() == 1 ? quantity : quantity + of_several;
      };
      of.push_back(value(named("position"), joint_unit_name(j.type, c)));
      of.push_back(value(named("velocity"), joint_unit_name(j.type, c, true)));
    }
  }
  out_.constant.resize(out_.columns);
}

/// As outputs of joints count turns: nearest to q_last + (t - t_last) (qdot_last + qdot) / 2.
double EffortCollector::follow(const SystemMotion& motion, Followed& f) {
  const Joint& j = model_.joints[f.joint];
  const MarkerState &F = motion.marker(j.frame_F), &M = motion.marker(j.frame_M);
  const double rate = joint_velocity(j, F, M, f.component);
  const double reference = f.started ? f.position + 0.5 * (motion.t - f.time) * (f.rate + rate)
                                     : motion.start_position(f.joint, f.component);
  f = {f.joint, f.component, true, motion.t, joint_position(j, F, M, f.component, reference), rate};
  return f.position;
}

void EffortCollector::add(const SystemMotion& motion) {
  std::vector<double>& numbers = out_.numbers;
  auto result = results_.begin();
  for (int k = 0; k < std::ssize(out_.elements); ++k) {
    const SceneEfforts::OfElement& of = out_.elements[k];
    const Efforts& effort = motion.effort(k);
    if (of.port >= 0) {
      const Wrench& w = effort.wrench[of.port];
      for (const Vec3* x : {&w.F, &w.T}) numbers.insert(numbers.end(), x->begin(), x->end());
    }
    for (std::size_t v = 0; v < of.values.size(); ++v) numbers.push_back(effort.result(*result++));
  }
  for (Followed& f : followed_) {
    numbers.push_back(follow(motion, f));
    numbers.push_back(f.rate);
  }
}

SceneEfforts EffortCollector::take() {
  const std::size_t columns = out_.constant.size();
  std::ranges::fill(out_.constant, 1);
  for (std::size_t i = columns; i < out_.numbers.size(); ++i)
    if (out_.numbers[i] != out_.numbers[i % columns]) out_.constant[i % columns] = 0;
  return std::move(out_);
}

EffortWriter::EffortWriter(const SceneEfforts& efforts) : efforts_(efforts) {
  for (const char constant : efforts.constant) varying_ += constant == 0;
  int varying = 0, constants = varying_;
  for (const char constant : efforts.constant)
    place_.push_back(constant != 0 ? constants++ : varying++);
}

Json EffortWriter::numbers(std::size_t frames, PageBuffer& buffer) const {
  if (efforts_.empty()) return nullptr;
  Json constants = Json::array();
  std::vector<float> rows;
  const std::size_t columns = efforts_.constant.size();
  for (std::size_t i = 0; i < efforts_.numbers.size(); ++i)
    if (efforts_.constant[i % columns] == 0)
      rows.push_back(static_cast<float>(efforts_.numbers[i]));
    else if (i < columns)
      constants.push_back(efforts_.numbers[i]);
  Json out{{"data", nullptr}, {"constants", std::move(constants)}};
  if (!rows.empty())
    out["data"] = buffer.add(std::span<const float>(rows), {frames, rows.size() / frames});
  return out;
}

Json EffortWriter::values(const std::vector<SceneEfforts::Value>& values) const {
  Json out = Json::array();
  for (const SceneEfforts::Value& v : values)
    out.push_back({{"name", v.name}, {"unit", v.unit}, {"column", place_[v.column]}});
  return out;
}

void EffortWriter::add_element(int element, int point, Json& out) const {
  if (efforts_.empty()) return;
  const SceneEfforts::OfElement& of = efforts_.elements[element];
  out["values"] = values(of.values);
  if (of.port < 0) return;
  Json columns = Json::array();
  for (int k = 0; k < 6; ++k) columns.push_back(place_[of.wrench + k]);
  out["wrench"] = {{"at", point}, {"columns", std::move(columns)}};
}

Json EffortWriter::values_of_joint(int joint) const {
  return efforts_.empty() ? Json::array() : values(efforts_.joints[joint]);
}

}  // namespace floatframe
