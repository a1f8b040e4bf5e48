// Result columns: the markers, bodies, joints and forces they refer to, and their units.
#include <algorithm>

#include "floatframe/core/printable.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/model/gauge_place.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

void ModelBuilder::outputs() {
  output_list("outputs.", d.outputs, model.outputs);
  output_list("measures.", d.measures, model.measures);
}

void ModelBuilder::output_list(const std::string& list,
                               const std::vector<OutputDescription>& described,
                               std::vector<Output>& built) {
  for (const OutputDescription& o : described)
    if (auto out = output(o, list + o.name)) built.push_back(std::move(*out));
}

std::optional<Output> ModelBuilder::output(const OutputDescription& o, const std::string& who) {
  Output out;
  out.name = o.name;
  out.type = o.type;
  out.component = o.component;
  if (!subject(o, out, who) || !frames(o, out, who)) return std::nullopt;
  const OutputKind& kind = output_kind(o.type);
  if (kind.named_unit) {
    out.unit = o.unit.empty() ? kind.unit : o.unit;
    return out;
  }
  out.unit = kind.unit_of ? kind.unit_of(model, out) : kind.unit;
  if (!o.unit.empty() && !unit(o, out, who)) return std::nullopt;
  return out;
}

bool ModelBuilder::subject(const OutputDescription& o, Output& out, const std::string& who) {
  const std::string what = who + "." + output_type_name(o.type);
  const auto point = [&](const AttachmentDescription& at, const std::string& where,
                         bool oriented = false) {
    return add_marker(at, Mat3::Identity(), oriented, o.origin.mark, where);
  };
  const auto of_list = [&](ElementList list) {
    out.element = element(list, o.entity);
    return out.element >= 0;
  };
  switch (output_kind(o.type).of) {
    case OutputOf::formula:
    case OutputOf::crossing:
      return true;
    case OutputOf::point:
      out.marker = point(o.at, what);
      return out.marker >= 0;
    case OutputOf::two_points:
      out.marker = point(o.at, what + ".from");
      out.to = point(o.to, what + ".to");
      return out.marker >= 0 && out.to >= 0;
    case OutputOf::body:
      out.marker = body_frame(o.at.body);
      out.body = body_index(o.at.body);
      return true;
    case OutputOf::mass:
      return mass(o, out, who);
    case OutputOf::flexible_point:
      out.body = body_index(o.at.body);
      out.marker = point(o.at, what, true);
      out.relative = body_frame(o.at.body);
      return out.marker >= 0;
    case OutputOf::mode:
      out.body = body_index(o.at.body);
      return has_number(o, "mode", model.bodies[out.body].modes(), who);
    case OutputOf::joint:
      out.joint = joint_names.index(o.entity);
      return out.joint >= 0;
    case OutputOf::force:
      return of_list(ElementList::forces) &&
             (!output_kind(o.type).one_of_values || value_of_element(o, out, what));
    case OutputOf::rod:
      return of_list(ElementList::rods);
    case OutputOf::coupling:
      return of_list(ElementList::couplings);
    case OutputOf::path:
      return of_list(ElementList::constraints);
    case OutputOf::controller:
      return of_list(ElementList::controllers) && value_of_element(o, out, what);
    case OutputOf::motion: {
      const Joint& joint = model.joints[joint_names.index(o.entity)];
      out.element = joint.motions.empty() ? joint.motion : joint.motions[o.component];
      return out.element >= 0;
    }
    case OutputOf::state: {
      if (!of_list(ElementList::forces) && !of_list(ElementList::controllers)) return false;
      const Element& e = model.elements[out.element];
      if (e.states > 0) return has_number(o, "state", e.states, who);
      errors.add(ErrorCode::wrong_value, o.origin.mark,
                 what + ": " + sentences::load_without(element_type_name(e.type), "state"));
      return false;
    }
    case OutputOf::gauge:
      return gauge(o, out, who);
    case OutputOf::reaction:
      return reaction(o, out, who);
  }
  return false;
}

bool ModelBuilder::value_of_element(const OutputDescription& o, Output& out,
                                    const std::string& what) {
  const std::vector<std::string>& values = model.elements[out.element].values;
  out.component = value_index(values, o.value);
  if (out.component < 0)
    errors.add(ErrorCode::not_found, o.origin.mark,
               what + ": " + sentences::no_such_value(o.value, values));
  return out.component >= 0;
}

bool ModelBuilder::unit(const OutputDescription& o, Output& out, const std::string& who) {
  std::string known = out.unit;
  for (const OutputUnit& x : output_units) {
    if (out.unit != x.si) continue;
    known += std::string(" or ") + x.unit;
    if (o.unit != x.unit) continue;
    out.unit = x.unit;
    out.factor = x.factor;
    return true;
  }
  if (o.unit == out.unit) return true;
  errors.add(ErrorCode::wrong_value, o.origin.mark,
             who + ".unit: found '" + printable(o.unit) + "', expected " + known);
  return false;
}

bool ModelBuilder::has_number(const OutputDescription& o, const char* what, int n,
                              const std::string& who) {
  if (o.component >= 0 && o.component < n) return true;
  const bool from_file = !o.origin.mark.file.empty();
  const std::string key = from_file && what != std::string("state") ? what
                          : from_file                               ? "number"
                                                                    : "component";
  errors.add(ErrorCode::out_of_range, o.origin.mark,
             who + "." + key + ": " +
                 sentences::number_of((std::string("the number of a ") + what).c_str(), o.component,
                                      n, from_file));
  return false;
}

bool ModelBuilder::mass(const OutputDescription& o, Output& out, const std::string& who) {
  if (!o.whole) out.body = body_index(o.at.body);
  if (o.about) {
    out.marker = add_marker(o.to, Mat3::Identity(), false, o.origin.mark, who + ".about");
    if (out.marker < 0) return false;
  }
  if (o.type != OutputType::centre_of_mass || mass_of(model, out.body) > 0.0) return true;
  errors.add(ErrorCode::wrong_value, o.origin.mark,
             who + "." + output_type_name(o.type) + ": " + sentences::without_mass(o.whole));
  return false;
}

bool ModelBuilder::frames(const OutputDescription& o, Output& out, const std::string& who) {
  const auto frame = [&](const ReferenceDescription& x, const char* key, int& marker) {
    if (!x.place) {
      marker = body_frame(x.body);
      return true;
    }
    marker = add_marker(x, Mat3::Identity(), true, o.origin.mark, who + "." + key);
    return marker >= 0;
  };
  bool good = !o.relative || frame(*o.relative, "relative_to", out.relative);
  out.axes = out.relative;
  if (o.axes) good = frame(*o.axes, "in", out.axes) && good;
  return good;
}

bool ModelBuilder::gauge(const OutputDescription& o, Output& out, const std::string& who) {
  out.body = body_index(o.at.body);
  const Body& body = model.bodies[out.body];
  const Mat3 R_BW = body.X_WB.R.transpose();
  const Vec3 point = R_BW * (o.at.point - body.X_WB.p);
  const bool nearest = o.gauge.node == 0 && !o.at.node;
  GaugeDescription turned = o.gauge;
  for (Vec3* d : {&turned.toward, &turned.along, &turned.direction}) *d = R_BW * *d;
  const GaugeChoice found = find_place(*body.data, body.name, turned, nearest ? &point : nullptr,
                                       o.at.node.value_or(""), o.type == OutputType::section_force);
  if (!found.error.empty()) {
    // Each component is a separate output; an error of their location is reported once.
    const SourceMark& mark = o.origin.mark;
    const std::string place = mark.file + ":" + std::to_string(mark.line) + ":" +
                              std::to_string(mark.column) + ": " + found.error;
    if (mark.line > 0 && !wrong_gauges.insert(place).second) return false;
    errors.add(ErrorCode::wrong_value, o.origin.mark,
               who + "." + output_type_name(o.type) + ": " + found.error);
    return false;
  }
  Gauge g;
  g.body = out.body;
  g.place = found.place;
  g.section = found.section;
  g.inertia_loads = o.gauge.inertia_loads;
  if (o.type == OutputType::strain) g.direction = unit_vector(turned.direction);
  // Components at one location share the gauge.
  const auto same = std::find_if(model.gauges.begin(), model.gauges.end(), [&](const Gauge& other) {
    return other.body == g.body && other.place == g.place && other.section == g.section &&
           other.inertia_loads == g.inertia_loads && other.direction == g.direction;
  });
  out.gauge = static_cast<int>(same - model.gauges.begin());
  if (same != model.gauges.end()) return true;
  fill_rows(*body.data, g);
  model.gauges.push_back(std::move(g));
  return true;
}

int ModelBuilder::element(ElementList list, const std::string& name) const {
  const int k = element_names[index_of(list)].index(name);
  std::size_t before = 0;
  for (std::size_t other = 0; other < index_of(list); ++other)
    before += element_names[other].names().size();
  return k < 0 ? -1 : static_cast<int>(before) + k;
}

bool ModelBuilder::reaction(const OutputDescription& o, Output& out, const std::string& who) {
  if (o.rod || o.constraint)
    out.element = element(o.rod ? ElementList::rods : ElementList::constraints, o.entity);
  else
    out.joint = joint_names.index(o.entity);
  if (out.element < 0 && out.joint < 0) return false;
  if (o.about) {
    out.marker = add_marker(o.at, Mat3::Identity(), false, o.origin.mark, who + ".about");
    if (out.marker < 0) return false;
  }
  if (o.in == OutputAxes::parent) out.to = model.joints[out.joint].frame_F;
  if (o.in == OutputAxes::child) out.to = model.joints[out.joint].frame_M;
  if (o.in == OutputAxes::place) {
    out.to = add_marker(o.to, Mat3::Identity(), true, o.origin.mark, who + ".in");
    if (out.to < 0) return false;
  }
  return true;
}

}  // namespace floatframe
