#include "floatframe/export/stress_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/results/json_values.hpp"

namespace floatframe {
namespace {

const Body& body_of(const StressReport& report, const StressedBody& b) {
  return report.model->bodies[b.body];
}

const StressPlace& place_of(const Body& body, const HotSpot& spot) {
  return body.data->stress->places[spot.place];
}

const std::string& material_of(const Body& body, const StressPlace& place) {
  return body.data->stress->groups[place.group].name;
}

const BeamSectionPlace& section_of(const Body& body, const SectionPeak& peak) {
  return body.data->stress->sections[peak.section];
}

/// Values that are rounding noise relative to `largest` are shown as zero.
std::string mega(double pascal, double largest) {
  if (std::abs(pascal) < 1e-6 * largest) return "0";
  return fmt::format("{:.4g}", 1e-6 * pascal);
}

std::string hot_spot_table(const StressReport& report, const StressedBody& b) {
  const Body& body = body_of(report, b);
  TextTable table({"node", "where", "material", "x [m]", "y [m]", "z [m]", "von Mises [MPa]",
                   "time [s]", "principal 1", "2", "3", ""},
                  {1, 2, 11});
  for (const HotSpot& spot : b.hot_spots) {
    const StressPlace& place = place_of(body, spot);
    const double vm = spot.von_mises;
    table.add({stress_node_text(*body.data, place.node, place.number), layer_name(place.layer),
               material_of(body, place), fmt::format("{:.4f}", place.p.x()),
               fmt::format("{:.4f}", place.p.y()), fmt::format("{:.4f}", place.p.z()), mega(vm, vm),
               fmt::format("{:.6g}", spot.time), mega(spot.principal(0), vm),
               mega(spot.principal(1), vm), mega(spot.principal(2), vm),
               spot.doubtful ? "doubtful" : ""});
  }
  return table.text(2);
}

std::string peak_table(const StressReport& report, const StressedBody& b) {
  const Body& body = body_of(report, b);
  TextTable table({"section force", "largest", "", "of", "end at node", "time [s]"}, {2, 3, 4});
  double largest[2] = {0.0, 0.0};  // force, moment: 1e-9 of it is rounding
  for (const SectionPeak& peak : b.peaks)
    largest[peak.component / 3] = std::max(largest[peak.component / 3], std::abs(peak.value));
  for (const SectionPeak& peak : b.peaks) {
    const BeamSectionPlace& section = section_of(body, peak);
    if (std::abs(peak.value) <= 1e-9 * largest[peak.component / 3]) continue;
    table.add({section_force_name(peak.component), fmt::format("{:.5g}", peak.value),
               section_force_unit(peak.component), section.name,
               stress_node_text(*body.data, section.node, section.number),
               fmt::format("{:.6g}", peak.time)});
  }
  return table.text(2);
}

nlohmann::ordered_json hot_spot_json(const Body& body, const HotSpot& spot) {
  const StressPlace& place = place_of(body, spot);
  return {{"place", spot.place},
          {"node", stress_node_text(*body.data, place.node, place.number)},
          {"where", layer_name(place.layer)},
          {"material", material_of(body, place)},
          {"position_m", json_array(place.p)},
          {"von_mises_Pa", spot.von_mises},
          {"time_s", spot.time},
          {"principal_Pa", json_array(spot.principal)},
          {"doubtful", spot.doubtful}};
}

nlohmann::ordered_json body_json(const StressReport& report, const StressedBody& b) {
  const Body& body = body_of(report, b);
  const BodyStress& stress = *body.data->stress;
  nlohmann::ordered_json spots = nlohmann::ordered_json::array(), peaks = spots;
  for (const HotSpot& spot : b.hot_spots) spots.push_back(hot_spot_json(body, spot));
  for (const SectionPeak& peak : b.peaks) {
    const BeamSectionPlace& section = section_of(body, peak);
    peaks.push_back({{"force", section_force_name(peak.component)},
                     {"value", peak.value},
                     {"unit", section_force_unit(peak.component)},
                     {"element", section.name},
                     {"end", section.end},
                     {"node", stress_node_text(*body.data, section.node, section.number)},
                     {"time_s", peak.time}});
  }
  return {{"name", body.name},
          {"places", stress.places.size()},
          {"sections", stress.sections.size()},
          {"inertia_loads", stress.loads.size() + stress.section_loads.size() > 0},
          {"hot_spots", spots},
          {"section_forces", peaks}};
}

}  // namespace

std::string stress_text(const StressReport& report) {
  std::string text = fmt::format("{}: {} instants from {:.6g} to {:.6g} s\n", report.model->name,
                                 report.instants, report.from, report.to);
  for (const StressedBody& b : report.bodies) {
    const Body& body = body_of(report, b);
    const BodyStress& stress = *body.data->stress;
    text += fmt::format("\nbody '{}', {} places{}\n", body.name, stress.places.size(),
                        stress.loads.size() + stress.section_loads.size() > 0
                            ? ""
                            : ", of its modes alone: its loads are not known");
    if (!b.hot_spots.empty()) text += hot_spot_table(report, b);
    if (!b.peaks.empty()) text += peak_table(report, b);
  }
  for (const std::string& name : report.without)
    text += fmt::format("\nbody '{}' has no stress data\n", name);
  return text;
}

std::string stress_json(const StressReport& report) {
  nlohmann::ordered_json bodies = nlohmann::ordered_json::array();
  for (const StressedBody& b : report.bodies) bodies.push_back(body_json(report, b));
  return json_document({{"model", report.model->name},
                        {"instants", report.instants},
                        {"from_s", report.from},
                        {"to_s", report.to},
                        {"bodies", bodies},
                        {"without_stress", report.without}});
}

std::string hot_spots_csv(const StressReport& report) {
  std::string text =
      "body,place,node,where,material,x [m],y [m],z [m],von Mises [Pa],time [s],principal 1 [Pa],"
      "principal 2 [Pa],principal 3 [Pa],doubtful\n";
  for (const StressedBody& b : report.bodies) {
    const Body& body = body_of(report, b);
    for (const HotSpot& spot : b.hot_spots) {
      const StressPlace& place = place_of(body, spot);
      text +=
          fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(body.name),
                      spot.place, csv_field(stress_node_text(*body.data, place.node, place.number)),
                      layer_name(place.layer), csv_field(material_of(body, place)), place.p.x(),
                      place.p.y(), place.p.z(), spot.von_mises, spot.time, spot.principal(0),
                      spot.principal(1), spot.principal(2), spot.doubtful ? 1 : 0);
    }
  }
  return text;
}

std::string section_forces_csv(const StressReport& report) {
  std::string text =
      "body,element,end,node,force,unit,smallest,time of smallest [s],largest,"
      "time of largest [s]\n";
  for (const StressedBody& b : report.bodies) {
    const Body& body = body_of(report, b);
    const std::vector<BeamSectionPlace>& sections = body.data->stress->sections;
    for (std::size_t s = 0; s < sections.size(); ++s)
      for (int c = 0; c < 6; ++c) {
        const auto at = static_cast<Eigen::Index>(s);
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{}\n", csv_field(body.name), csv_field(sections[s].name),
            sections[s].end,
            csv_field(stress_node_text(*body.data, sections[s].node, sections[s].number)),
            section_force_name(c), section_force_unit(c), b.envelope.least(c, at),
            b.envelope.least_time(c, at), b.envelope.largest(c, at),
            b.envelope.largest_time(c, at));
      }
  }
  return text;
}

}  // namespace floatframe
