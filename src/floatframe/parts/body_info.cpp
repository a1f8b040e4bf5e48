#include "floatframe/parts/body_info.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/parts/json_vector.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

/// Frequencies of the modes with the body frame fixed: K x = w^2 M_ff x [Hz]; empty if the modal
/// mass is singular.
std::vector<double> frequencies(const FlexibleBody& body) {
  const MatX M = modal_mass(body.invariants);
  std::vector<double> out;
  if (M.rows() == 0) return out;
  const SymmetricEigen modes = generalised_eigenvalues(body.K, M);
  if (!modes.found) return out;
  for (const double w2 : modes.values) out.push_back(hertz_of_eigenvalue(w2));
  return out;
}

std::string properties_text(const FlexibleBody& body) {
  const InertiaInvariants& v = body.invariants;
  const Vec3 c = v.centre_of_mass();
  const Mat3 J = v.inertia_about_centre();
  return fmt::format(
      "  mass             {:.8g} kg\n  centre of mass   {:.6g} {:.6g} {:.6g} m\n"
      "  inertia about it {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} {:.6g} kg m2 (xx yy zz xy xz yz)\n",
      v.m, c.x(), c.y(), c.z(), J(0, 0), J(1, 1), J(2, 2), J(0, 1), J(0, 2), J(1, 2));
}

std::string stiffening_text(const FlexibleBody& body) {
  return fmt::format("  stiffening data  {}\n  turning masses   {}\n",
                     body.second_order ? "yes" : "no", body.turning ? "yes" : "no");
}

std::string tables_text(const FlexibleBody& body) {
  std::string text;
  if (body.modes() > 0) {
    const std::vector<double> together = frequencies(body);
    const VecX alone = mode_frequencies(body);
    TextTable modes({"mode", "name", "alone [Hz]", "together [Hz]"}, {1});
    for (int k = 0; k < body.modes(); ++k) {
      const std::size_t i = k;
      modes.add({std::to_string(k + 1), i < body.mode_names.size() ? body.mode_names[i] : "",
                 std::isfinite(alone[k]) ? hertz_text(alone[k]) : "-",
                 i < together.size() ? hertz_text(together[i]) : "-"});
    }
    text += '\n' + modes.text(2) +
            "  alone: this mode by itself; together: ascending eigenfrequencies of (K, M_ff), with "
            "the body frame held\n";
  }
  if (body.fixed_interface_frequencies.size() > 0) {
    text += "  normal modes [Hz]:";
    for (const double f : body.fixed_interface_frequencies) text += ' ' + hertz_text(f);
    text += '\n';
  }
  if (!body.nodes.empty()) {
    TextTable markers({"marker", "x [m]", "y [m]", "z [m]"});
    for (const ModalNode& n : body.nodes)
      markers.add({n.name, fmt::format("{:.6g}", n.p.x()), fmt::format("{:.6g}", n.p.y()),
                   fmt::format("{:.6g}", n.p.z())});
    text += '\n' + markers.text(2);
  }
  return text;
}

Json body_json(const FlexibleBody& body) {
  const InertiaInvariants& v = body.invariants;
  const Mat3 J = v.inertia_about_centre();
  Json modes = Json::array(), markers = Json::array();
  const VecX alone = mode_frequencies(body);
  for (int k = 0; k < body.modes(); ++k) {
    const std::size_t i = k;
    modes.push_back({{"name", i < body.mode_names.size() ? body.mode_names[i] : ""},
                     {"frequency_Hz", std::isfinite(alone[k]) ? Json(alone[k]) : Json()}});
  }
  Json normal = Json::array();
  for (const double f : body.fixed_interface_frequencies) normal.push_back(f);
  for (const ModalNode& n : body.nodes)
    markers.push_back({{"name", n.name}, {"position_m", json_vector(n.p)}});
  return {{"mass_kg", v.m},
          {"centre_of_mass_m", json_vector(v.centre_of_mass())},
          {"inertia_about_centre_kgm2",
           {json_vector(J.row(0).transpose()), json_vector(J.row(1).transpose()),
            json_vector(J.row(2).transpose())}},
          {"modes", modes},
          {"frequencies_frame_held_Hz", frequencies(body)},
          {"normal_mode_frequencies_Hz", normal},
          {"markers", markers},
          {"projection", body.projection != nullptr},
          {"geometric_stiffening", body.second_order != nullptr},
          {"turning_masses", body.turning != nullptr}};
}

std::string dump(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace

std::string body_info_text(const std::string& file, const BodyFile& content) {
  const FlexibleBody& body = content.part.body;
  const Provenance& from = content.provenance;
  std::string text = fmt::format("{}: body file, {} modes (SI units)\n\n", file, body.modes());
  text += properties_text(body);
  text += fmt::format("  surface          {} points, {} triangles, {} lines{}\n",
                      content.part.surface.nodes.size(), content.part.surface.triangles.size(),
                      content.part.surface.lines.size(), body.stress ? ", with stresses" : "");
  text += fmt::format("  projection data  {}\n", body.projection ? "yes" : "no");
  text += stiffening_text(body);
  text += fmt::format("  made from        {} ({}) by Floatframe {}, {}\n", printable(from.source),
                      printable(from.units), printable(from.version), printable(from.date));
  text += fmt::format("  fingerprint      {} of {} file{}\n", printable(from.source_hash),
                      from.files.size(), from.files.size() == 1 ? "" : "s");
  for (const auto& [option, value] : from.options)
    text +=
        fmt::format("  --{}{}\n", printable(option), value == "true" ? "" : " " + printable(value));
  text += tables_text(body) + "\nHealth report: " + health_text(content.part.health);
  return printable(text, true);
}

std::string body_info_json(const std::string& file, const BodyFile& content) {
  const Provenance& from = content.provenance;
  Json json = {{"file", file}, {"kind", "body file"}, {"format_version", body_file_version}};
  json.update(body_json(content.part.body));
  Json options = Json::array(), files = Json::array();
  for (const auto& [option, value] : from.options) options.push_back({option, value});
  for (const auto& [name, hash] : from.files) files.push_back({{"file", name}, {"hash", hash}});
  json["provenance"] = {{"source", from.source},
                        {"source_hash", from.source_hash},
                        {"units", from.units},
                        {"options", options},
                        {"files", files},
                        {"date", from.date},
                        {"floatframe", from.version}};
  json["health"] = Json::parse(health_json(content.part.health));
  return dump(json);
}

std::string sid_info_text(const std::string& file, const FlexibleBody& body,
                          const std::vector<std::string>& notes) {
  std::string text = fmt::format("{}: SID_FEM, {} modes (SI units)\n\n", file, body.modes()) +
                     properties_text(body) + stiffening_text(body) + tables_text(body);
  if (!notes.empty()) text += "\nNotes\n";
  for (const std::string& note : notes) text += "  - " + note + '\n';
  return printable(text, true);
}

std::string sid_info_json(const std::string& file, const FlexibleBody& body,
                          const std::vector<std::string>& notes) {
  Json json = {{"file", file}, {"kind", "SID_FEM"}};
  json.update(body_json(body));
  json["notes"] = notes;
  return dump(json);
}

}  // namespace floatframe
