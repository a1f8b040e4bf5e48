// Result columns: the markers, bodies, joints and forces they refer to, and their units.
#include <algorithm>

#include "floatframe/description/sentences.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/model/gauge_place.hpp"
#include "floatframe/model/model_builder.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {

void ModelBuilder::outputs() {
  for (const OutputDescription& o : d.outputs) {
    const OutputKind& kind = output_kind(o.type);
    Output out;
    out.name = o.name;
    out.type = o.type;
    out.component = o.component;
    const std::string who = "outputs." + o.name;
    const std::string what = who + "." + output_type_name(o.type);
    const auto point = [&](const AttachmentDescription& at, const std::string& where) {
      return add_marker(at, Mat3::Identity(), false, o.origin.mark, where);
    };
    bool built = true;  // else it, or what it refers to, has an error
    switch (kind.of) {
      case OutputOf::point:
        out.marker = point(o.at, what);
        built = out.marker >= 0;
        break;
      case OutputOf::two_points:
        out.marker = point(o.at, what + ".from");
        out.to = point(o.to, what + ".to");
        built = out.marker >= 0 && out.to >= 0;
        break;
      case OutputOf::body:
        out.body = body_index(o.at.body);
        break;
      case OutputOf::mode: {
        out.body = body_index(o.at.body);
        const int nm = model.bodies[out.body].modes();
        built = o.component >= 0 && o.component < nm;
        if (!built) {
          const bool from_file = !o.origin.mark.file.empty();
          errors.add(ErrorCode::out_of_range, o.origin.mark,
                     who + (from_file ? ".mode: " : ".component: ") +
                         sentences::number_of("the number of a mode", o.component, nm, from_file));
        }
        break;
      }
      case OutputOf::joint:
        out.joint = joint_names.index(o.entity);
        built = out.joint >= 0;
        break;
      case OutputOf::force:
        out.element = element(ElementList::forces, o.entity);
        built = out.element >= 0;
        break;
      case OutputOf::rod:
        out.element = element(ElementList::rods, o.entity);
        built = out.element >= 0;
        break;
      case OutputOf::coupling:
        out.element = element(ElementList::couplings, o.entity);
        built = out.element >= 0;
        break;
      case OutputOf::controller:
        out.element = element(ElementList::controllers, o.entity);
        built = out.element >= 0;
        break;
      case OutputOf::motion:
        out.element = element(ElementList::motions, o.entity);
        built = out.element >= 0;
        break;
      case OutputOf::gauge:
        built = gauge(o, out, who);
        break;
      case OutputOf::reaction:
        built = reaction(o, out, who);
        break;
    }
    if (!built) continue;
    out.unit = kind.unit_of ? kind.unit_of(model, out) : kind.unit;
    model.outputs.push_back(std::move(out));
  }
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
  (o.rod ? out.element : out.joint) =
      o.rod ? element(ElementList::rods, o.entity) : joint_names.index(o.entity);
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
