#include "floatframe/export/stress_report.hpp"
#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"

namespace floatframe {
namespace {

class EnvelopeMembers {
 public:
  void numbers(const std::string& name, std::vector<std::size_t> shape, const MatX& columns) {
    keep(name, npy_bytes({std::move(shape),
                          std::vector<double>(columns.data(), columns.data() + columns.size())}));
  }
  void texts(const std::string& name, const std::vector<std::string>& all) {
    keep(name, npy_texts(all));
  }
  void flags(const std::string& name, const std::vector<std::int32_t>& all) {
    keep(name, npy_bytes({{all.size()}, all}));
  }
  std::string archive() const {
    std::vector<ZipMember> members;
    for (const auto& [name, content] : members_) members.push_back({name, content});
    return zip_archive(members);
  }

 private:
  void keep(const std::string& name, std::string content) {
    members_.emplace_back(name + ".npy", std::move(content));
  }
  std::vector<std::pair<std::string, std::string>> members_;
};

void add_envelope(EnvelopeMembers& out, const Body& body, const StressEnvelope& envelope) {
  const BodyStress& stress = *body.data->stress;
  const std::string at = body.name + "/";
  const std::size_t places = stress.places.size(), sections = stress.sections.size();
  out.numbers(at + "von_mises", {places}, envelope.von_mises);
  out.numbers(at + "time", {places}, envelope.time);
  out.numbers(at + "stress", {places, 6}, envelope.stress);
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
  out.numbers(at + "positions", {places, 3}, positions);
  out.texts(at + "nodes", nodes);
  out.flags(at + "points", points);
  out.texts(at + "layers", layers);
  out.texts(at + "materials", materials);
  out.flags(at + "doubtful", doubtful);
  if (sections == 0) return;
  out.numbers(at + "section_least", {sections, 6}, envelope.least);
  out.numbers(at + "section_least_time", {sections, 6}, envelope.least_time);
  out.numbers(at + "section_largest", {sections, 6}, envelope.largest);
  out.numbers(at + "section_largest_time", {sections, 6}, envelope.largest_time);
  std::vector<std::string> elements, ends;
  for (const BeamSectionPlace& section : stress.sections) {
    elements.push_back(section.name);
    ends.push_back(stress_node_text(*body.data, section.node, section.number));
  }
  out.texts(at + "section_elements", elements);
  out.texts(at + "section_nodes", ends);
}

}  // namespace

std::string envelope_npz(const StressReport& report) {
  EnvelopeMembers out;
  std::vector<std::string> names;
  for (const StressedBody& b : report.bodies)
    names.push_back(report.model->bodies[static_cast<std::size_t>(b.body)].name);
  out.texts("bodies", names);
  for (const StressedBody& b : report.bodies)
    add_envelope(out, report.model->bodies[static_cast<std::size_t>(b.body)], b.envelope);
  return out.archive();
}

}  // namespace floatframe
