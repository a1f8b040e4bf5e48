#include "floatframe/page/page_tables.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/core/text_pieces.hpp"
#include "floatframe/description/joint_list.hpp"
#include "floatframe/history/history_content.hpp"

namespace floatframe {
namespace {

const char* type_text(const FlexibleBody& data) {
  if (data.modes() == 0) return "rigid";
  if (data.shape && !data.shape->bars.empty()) return "flexible, bars";
  return "flexible, part";
}

/// Number of modes by kind, as given by their names.
std::string modes_text(const FlexibleBody& data) {
  const int all = data.modes();
  if (all == 0) return "";
  int normal = 0;
  for (const std::string& name : data.mode_names) normal += name.starts_with("normal") ? 1 : 0;
  if (normal == 0 || normal == all) return std::to_string(all);
  return fmt::format("{}: {} static, {} normal", all, all - normal, normal);
}

/// How the mass of finite elements enters the inertia terms.
const char* mass_text(const FlexibleBody& data) {
  if (data.modes() == 0) return "";
  switch (data.mass_model) {
    case MassModel::isoparametric:
      return data.projection ? "scalar mass of each node" : "integrals of the part";
    case MassModel::six_dof:
      return "consistent, with rotations";
    case MassModel::hermite:
      break;
  }
  return "exact integrals of beams";
}

std::string short_number(double value, const char* format) {
  return std::isfinite(value) ? fmt::format(fmt::runtime(format), value) : std::string();
}

/// "x", or a unit vector.
std::string direction_text(const Vec3& d) {
  for (int k = 0; k < 3; ++k)
    if (d[k] > 1.0 - 1e-9) return std::string(1, "xyz"[k]);
  const auto rounded = [](double x) { return std::abs(x) < 5e-4 ? 0.0 : x; };
  return fmt::format("({:.3g}, {:.3g}, {:.3g})", rounded(d[0]), rounded(d[1]), rounded(d[2]));
}

void add_modes(const Body& body, PageTable& table) {
  const FlexibleBody& data = *body.data;
  const std::vector<double> own = own_frequencies(data);
  for (std::size_t k = 0; k < own.size(); ++k)
    table.rows.push_back({body.name, std::to_string(k + 1),
                          k < data.mode_names.size() ? data.mode_names[k] : "",
                          short_number(own[k], "{:.4g}")});
}

}  // namespace

std::string body_name(const Model& model, int marker) {
  const int body = marker < 0 ? -1 : model.markers[marker].body;
  return body < 0 ? ground_name : model.bodies[body].name;
}

std::vector<PageTable> body_tables(const Model& model) {
  PageTable bodies{
      "Bodies", {"body", "type", "mass [kg]", "modes", "nodes", "inertia from"}, {}, {}};
  PageTable modes{"Modes",
                  {"body", "mode", "name", "frequency [Hz]"},
                  {},
                  "Each mode alone, with the frame of the body held."};
  for (const Body& body : model.bodies) {
    const FlexibleBody& data = *body.data;
    bodies.rows.push_back(
        {body.name, type_text(data), short_number(data.invariants.m, "{:.6g}"), modes_text(data),
         data.nodes.empty() ? "" : std::to_string(data.nodes.size()), mass_text(data)});
    add_modes(body, modes);
  }
  std::vector<PageTable> out{std::move(bodies)};
  if (!modes.rows.empty()) out.push_back(std::move(modes));
  return out;
}

PageTable bending_table(const Model& model) {
  PageTable table{"Bending of bars",
                  {"body", "bars", "bend along", "E I [N m2]", "bend along", "E I [N m2]"},
                  {},
                  "Directions in the design configuration; an upright rectangle is stiffest along "
                  "its height."};
  for (const BarBending& b : model.hints.bending) {
    const std::string& body = model.bodies[b.body].name;
    const std::string stiffness = short_number(b.stiffness[0], "{:.5g}");
    if (b.alike())
      table.rows.push_back({body, names_text(b.bars, 3), "any", stiffness, "", ""});
    else
      table.rows.push_back({body, names_text(b.bars, 3), direction_text(b.direction[0]), stiffness,
                            direction_text(b.direction[1]),
                            short_number(b.stiffness[1], "{:.5g}")});
  }
  return table;
}

std::vector<PageTable> coordinate_tables(const Model& model, const ModelCounts& c) {
  PageTable coordinates{"Coordinates", {"", "relative", "absolute"}, {}, {}};
  const auto row = [&](const char* name, int relative, int absolute) {
    coordinates.rows.push_back({name, std::to_string(relative), std::to_string(absolute)});
  };
  row("rigid coordinates", c.relative.rigid, c.absolute.rigid);
  row("elastic coordinates", c.relative.elastic, c.absolute.elastic);
  row("all coordinates", c.relative.total, c.absolute.total);
  row("constraints", c.relative.constraints, c.absolute.constraints);
  row("degrees of freedom", c.degrees_of_freedom, c.degrees_of_freedom);
  if (c.redundant_constraints > 0)
    coordinates.note = fmt::format("Redundant constraints: {}.", c.redundant_constraints);
  std::vector<PageTable> out{std::move(coordinates)};
  if (c.cut_joint_names.empty()) return out;
  PageTable cut{"Joints cut in relative coordinates",
                {"joint", "type", "parent", "child"},
                {},
                "Each loop is closed by constraints where a joint or rod is cut."};
  for (const std::string& name : c.cut_joint_names) {
    std::vector<std::string> shown{name, "", "", ""};
    for (const Joint& j : model.joints)
      if (j.name == name)
        shown = {name, joint_type_name(j.type), body_name(model, j.frame_F),
                 body_name(model, j.frame_M)};
    cut.rows.push_back(std::move(shown));
  }
  out.push_back(std::move(cut));
  return out;
}

}  // namespace floatframe
