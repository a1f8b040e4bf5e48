#include "floatframe/export/npz_file.hpp"
#include "floatframe/export/stress_report.hpp"

namespace floatframe {
namespace {

std::vector<double> numbers_of(const MatX& columns) {
  return {columns.data(), columns.data() + columns.size()};
}

void add_envelope(NpzFile& out, const Body& body, const StressEnvelope& envelope) {
  const BodyStress& stress = *body.data->stress;
  const std::string at = body.name + "/";
  const std::size_t places = stress.places.size(), sections = stress.sections.size();
  out.add(at + "von_mises", {places}, numbers_of(envelope.von_mises));
  out.add(at + "time", {places}, numbers_of(envelope.time));
  out.add(at + "stress", {places, 6}, numbers_of(envelope.stress));
  MatX positions(3, stress.places.size());
  std::vector<std::int32_t> points, doubtful;
  std::vector<std::string> nodes, layers, materials;
  for (const StressPlace& place : stress.places) {
    positions.col(static_cast<Eigen::Index>(nodes.size())) = place.p;
    nodes.push_back(stress_node_text(*body.data, place.node, place.number));
    points.push_back(place.point);
    doubtful.push_back(place.doubtful ? 1 : 0);
    layers.emplace_back(layer_name(place.layer));
    materials.push_back(stress.groups[static_cast<std::size_t>(place.group)].name);
  }
  out.add(at + "positions", {places, 3}, numbers_of(positions));
  out.add(at + "nodes", nodes);
  out.add(at + "points", {places}, points);
  out.add(at + "layers", layers);
  out.add(at + "materials", materials);
  out.add(at + "doubtful", {places}, doubtful);
  if (sections == 0) return;
  out.add(at + "section_least", {sections, 6}, numbers_of(envelope.least));
  out.add(at + "section_least_time", {sections, 6}, numbers_of(envelope.least_time));
  out.add(at + "section_largest", {sections, 6}, numbers_of(envelope.largest));
  out.add(at + "section_largest_time", {sections, 6}, numbers_of(envelope.largest_time));
  std::vector<std::string> elements, ends;
  for (const BeamSectionPlace& section : stress.sections) {
    elements.push_back(section.name);
    ends.push_back(stress_node_text(*body.data, section.node, section.number));
  }
  out.add(at + "section_elements", elements);
  out.add(at + "section_nodes", ends);
}

}  // namespace

std::string envelope_npz(const StressReport& report) {
  NpzFile out;
  std::vector<std::string> names;
  for (const StressedBody& b : report.bodies)
    names.push_back(report.model->bodies[static_cast<std::size_t>(b.body)].name);
  out.add("bodies", names);
  for (const StressedBody& b : report.bodies)
    add_envelope(out, report.model->bodies[static_cast<std::size_t>(b.body)], b.envelope);
  return out.bytes();
}

}  // namespace floatframe
