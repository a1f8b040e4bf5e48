#include "floatframe/apps/reduce_page.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/core/build_info.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/page/page_json.hpp"
#include "floatframe/page/scene_json.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

Json text_table(const char* heading, std::vector<std::string> columns, Json rows) {
  return {{"heading", heading}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

Json interface_rows(const HealthReport& h) {
  Json rows = Json::array();
  for (const InterfaceHealth& i : h.interfaces)
    rows.push_back({i.name, i.kind, std::to_string(i.nodes),
                    fmt::format("{:.4g}, {:.4g}, {:.4g}", i.p.x(), i.p.y(), i.p.z()),
                    i.condition > 0.0 ? fmt::format("{:.1f}", i.condition) : "-",
                    fmt::format("{:.2g}", i.static_error)});
  return rows;
}

Json mode_rows(const HealthReport& h) {
  Json rows = Json::array();
  for (const ModeHealth& m : h.normal_modes) {
    Json row{m.name, hertz_text(m.frequency)};
    for (int k = 0; k < 6; ++k) row.push_back(fmt::format("{:.1f}", 100.0 * m.effective_mass[k]));
    row.push_back(m.kept ? "yes" : "no");
    rows.push_back(std::move(row));
  }
  return rows;
}

Json free_rows(const HealthReport& h) {
  Json rows = Json::array();
  for (const FrequencyPair& p : h.free_frequencies)
    rows.push_back(
        {std::to_string(rows.size() + 1), hertz_text(p.full), hertz_text(p.reduced),
         p.full > 0.0 ? fmt::format("{:+.4f}", 100.0 * p.relative_error()) : std::string("-")});
  return rows;
}

Json health_tables(const HealthReport& h) {
  const MassProperties &a = h.from_elements, &b = h.from_invariants;
  Json mass = Json::array();
  const auto row = [&](const std::string& what, double x, double y) {
    mass.push_back({what, fmt::format("{:.6g}", x), fmt::format("{:.6g}", y)});
  };
  row("mass [kg]", a.mass, b.mass);
  for (int i = 0; i < 3; ++i)
    row(fmt::format("centre of mass {} [m]", "xyz"[i]), a.centre[i], b.centre[i]);
  for (int i = 0; i < 3; ++i)
    row(fmt::format("inertia about the origin {0}{0} [kg m2]", "xyz"[i]), a.J_origin(i, i),
        b.J_origin(i, i));
  return Json::array(
      {text_table("Mass properties", {"", "finite elements", "reduced"}, std::move(mass)),
       text_table("Interfaces",
                  {"interface", "kind", "nodes", "place [m]", "condition", "static error"},
                  interface_rows(h)),
       text_table("Normal modes, effective mass [% of mass and inertia]",
                  {"normal mode", "[Hz]", "x", "y", "z", "rx", "ry", "rz", "kept"}, mode_rows(h)),
       text_table("Free frequencies of the reduced against the full model",
                  {"free elastic mode", "full [Hz]", "reduced [Hz]", "error [%]"}, free_rows(h))});
}

/// The part as the only body of a model.
Model model_of_part(const BodyFile& content, const std::string& name) {
  const ReducedPart& part = content.part;
  BodyShape shape;
  shape.positions = part.surface_positions;
  shape.modes = part.surface_modes;
  shape.triangles = part.surface.triangles;
  shape.lines = part.surface.lines;
  shape.nodes = part.surface.nodes;
  Model model;
  model.name = name;
  Body body;
  body.name = name;
  if (shape.positions.cols() > 0)
    body.length =
        (shape.positions.rowwise().maxCoeff() - shape.positions.rowwise().minCoeff()).maxCoeff();
  FlexibleBody data = part.body;
  data.shape = std::make_shared<const BodyShape>(std::move(shape));
  body.data = std::make_shared<const FlexibleBody>(std::move(data));
  model.bodies.push_back(std::move(body));
  return model;
}

/// For each interface, the surface points that it moves rigidly.
Json spiders(const ReducedPart& part, const Json& points, PageBuffer& buffer) {
  Json out = Json::array();
  const Eigen::Index n = part.surface_positions.cols();
  if (part.body.modes() == 0 || n == 0) return out;
  const double limit = 1e-9 * part.surface_modes.cwiseAbs().maxCoeff();
  for (const ModalNode& node : part.body.nodes) {
    std::vector<std::uint32_t> vertices;
    for (int k = 0; k < n; ++k)
      if (distance_from_rigid(part, node, k) <= limit)
        vertices.push_back(static_cast<std::uint32_t>(k));
    for (std::size_t p = 0; p < points.size(); ++p)
      if (points[p]["name"] == node.name && !vertices.empty())
        out.push_back({{"point", p},
                       {"vertices",
                        buffer.add(std::span<const std::uint32_t>(vertices), {vertices.size()})}});
  }
  return out;
}

}  // namespace

bool is_page_name(const std::string& file) {
  const auto extension = std::filesystem::path(file).extension();
  return extension == ".html" || extension == ".htm";
}

std::string part_page(const BodyFile& content) {
  const HealthReport& health = content.part.health;
  const std::string name = std::filesystem::path(content.provenance.source).stem().string();
  const Model model = model_of_part(content, name);
  PageBuffer buffer;
  Json scene = scene_json(model, SceneFrames{}, buffer);
  scene["bodies"][0]["spiders"] = spiders(content.part, scene["points"], buffer);
  FactTable facts{"Part",
                  {{"source", content.provenance.source},
                   {"units", content.provenance.units},
                   {"nodes", std::to_string(health.nodes)},
                   {"elements", std::to_string(health.elements)},
                   {"degrees of freedom", std::to_string(health.dofs)},
                   {"modes", std::to_string(health.modes)}}};
  for (const auto& [option, value] : content.provenance.options)
    facts.rows.push_back({option, value});
  Json page = empty_page(
      "reduce", name, build_description(),
      {{"state", "completed"}, {"sentences", health.notes}, {"warnings", health.warnings}});
  page["facts"] = facts_json({std::move(facts)});
  page["tables"] = health_tables(health);
  page["scene"] = std::move(scene);
  return page_html(page_template(), page, buffer);
}

}  // namespace floatframe
