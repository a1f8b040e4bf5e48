#include "floatframe/bench/chain_model.hpp"

#include <algorithm>

namespace floatframe {
namespace {

constexpr double length = 1.0, side = 0.02;  // [m]
constexpr int static_modes = 6;

std::string link_name(int i) { return "link_" + std::to_string(i + 1); }

AttachmentDescription at(const std::string& body, const char* node, double x) {
  AttachmentDescription place;
  place.body = body;
  place.point = Vec3(x, 0.0, 0.0);
  if (body != ground_name) place.node = node;
  return place;
}

/// Joints and outputs of links that have nodes "start" and "end".
void add_joints_and_outputs(ModelDescription& d) {
  const int links = static_cast<int>(d.bodies.size());
  for (int i = 0; i < links; ++i) {
    JointDescription hinge;
    hinge.name = "hinge_" + std::to_string(i + 1);
    hinge.type = JointType::revolute;
    hinge.axis = Vec3::UnitY();
    hinge.parent = at(i == 0 ? ground_name : link_name(i - 1), "end", i * length);
    hinge.child = at(link_name(i), "start", i * length);
    d.joints.push_back(hinge);
  }
  for (int component = 0; component < 3; ++component) {
    OutputDescription tip;
    tip.name = std::string("tip.") + "xyz"[component];
    tip.type = OutputType::position;
    tip.at = at(link_name(links - 1), "end", links * length);
    tip.component = component;
    d.outputs.push_back(tip);
  }
}

ModelDescription empty_chain(int links) {
  ModelDescription d;
  d.name = "chain_" + std::to_string(links);
  d.simulation.step = 1e-3;
  d.simulation.duration = 2.0;
  return d;
}

BodyDescription placed_link(int i) {
  BodyDescription body;
  body.name = link_name(i);
  body.X_WB.p = Vec3(i * length, 0.0, 0.0);
  body.X_WT = body.X_WB;
  return body;
}

}  // namespace

int largest_chain_modes(int elements) noexcept { return elements < 3 ? 1 : 2 * elements; }

ModelDescription chain_model(int links, int modes, int elements) {
  ModelDescription d = empty_chain(links);
  for (int i = 0; i < links; ++i) {
    FlexibleDescription beam;
    beam.young = 2.0e11;
    beam.poisson = 0.3;
    beam.density = 7500.0;
    beam.points["start"] = Vec3(i * length, 0.0, 0.0);
    beam.points["end"] = Vec3((i + 1) * length, 0.0, 0.0);
    BarDescription bar;
    bar.name = "bar";
    bar.from = "start";
    bar.to = "end";
    bar.elements = elements;
    bar.section = Rectangle{side, side};
    beam.bars.push_back(bar);
    beam.clamped.push_back({"start", 63u});
    // One entry per degree of freedom: the order of the modes is that of the entries.
    constexpr unsigned order[static_modes] = {1u << 2, 1u << 4, 1u << 1, 1u << 5, 1u << 0, 1u << 3};
    for (int k = 0; k < std::min(modes, static_modes); ++k)
      beam.interfaces.push_back({"end", order[k]});
    beam.normal_modes = std::max(0, modes - static_modes);
    BodyDescription body = placed_link(i);
    body.kind = beam;
    d.bodies.push_back(body);
  }
  add_joints_and_outputs(d);
  return d;
}

ModelDescription chain_model(int links, const FlexibleBody& link) {
  ModelDescription d = empty_chain(links);
  for (int i = 0; i < links; ++i) {
    BodyDescription body = placed_link(i);
    body.kind = link;
    d.bodies.push_back(body);
  }
  add_joints_and_outputs(d);
  return d;
}

}  // namespace floatframe
