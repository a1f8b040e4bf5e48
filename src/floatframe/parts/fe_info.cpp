#include "floatframe/parts/fe_info.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "floatframe/core/plural.hpp"
#include "floatframe/core/text_table.hpp"
#include "floatframe/fe/element_faces.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/unit_system.hpp"
#include "floatframe/math/vector_text.hpp"
#include "floatframe/parts/beam_arms.hpp"
#include "floatframe/parts/json_vector.hpp"
#include "floatframe/parts/part_text.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

/// Masses of the plies of a solid: its mass in proportion to thickness times density of each ply.
void share_plies(const FeModel& model, const FeElement& element, double mass, FeFacts& out) {
  const std::vector<ShellPly>& plies = model.layups[element.layup].plies;
  const auto weight = [&](const ShellPly& ply) {
    return ply.thickness * model.materials[ply.material].density;
  };
  double sum = 0.0;
  for (const ShellPly& ply : plies) sum += weight(ply);
  if (!(sum > 0.0)) return;
  for (const ShellPly& ply : plies) out.material_masses[ply.material] += mass * (weight(ply) / sum);
}

/// Masses of the materials of one element: shares by the thickness of plies, and the nonstructural
/// mass of its section.
void share(const FeModel& model, const FeElement& element, double volume, double mass,
           FeFacts& out) {
  if (element.layup >= 0) return share_plies(model, element, mass, out);
  const ShellSection* shell =
      has_shell_section(element.type) ? &model.shells[element.section] : nullptr;
  if (shell == nullptr || shell->plies.empty()) {
    const double own = volume * model.materials[element.material].density;
    out.material_masses[element.material] += own;
    out.other_mass += mass - own;
    return;
  }
  for (const ShellPly& ply : shell->plies) {
    const double own =
        volume * ply.thickness / shell->thickness * model.materials[ply.material].density;
    out.material_masses[ply.material] += own;
    mass -= own;
  }
  out.other_mass += mass;
}

/// The message of a reduction; empty if the element is valid.
std::string element_error(const FeModel& model, const FeElement& element,
                          const ElementInput& input) {
  const auto last = element.nodes.begin() + element_nodes(element.type);
  for (auto node = element.nodes.begin(); node != last; ++node)
    if (std::find(element.nodes.begin(), node, *node) != node)
      return fmt::format("names {} twice", model.node_label(*node));
  return element_kernel(element.type).error(input);
}

/// Volume and mass: elements of unit density, so that they can be evaluated without a material.
void measure(FeModel model, FeFacts& out) {
  const FeModel given = model;
  if (model.materials.empty()) model.materials.push_back({1.0, 0.3, 1.0});
  for (Material& m : model.materials) m = {1.0, 0.3, 1.0};
  for (ShellSection& s : model.shells) s.mass = 0.0;
  out.material_masses.assign(given.materials.size(), 0.0);
  const auto in_range = [&](int material) {
    return material >= 0 && material < static_cast<int>(given.materials.size());
  };
  MatX M;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    FeElement& element = model.elements[e];
    const int material = element.material;
    if (!in_range(material)) element.material = 0;
    const ElementInput input = gather(model, element);
    const ElementKernel& kernel = element_kernel(element.type);
    if (const std::string error = element_error(model, element, input); !error.empty()) {
      if (out.bad_elements.empty()) {
        out.bad_reason = error;
        out.bad_mark = model.mark(element.source);
      }
      out.bad_elements.push_back(model.element_label(static_cast<int>(e)));
      continue;
    }
    kernel.scalar_mass(input, M);
    const double volume = M.sum();
    out.volume += volume;
    if (!in_range(material)) continue;
    kernel.scalar_mass(gather(given, given.elements[e]), M);
    out.mass += M.sum();
    share(given, given.elements[e], volume, M.sum(), out);
  }
  for (const PointMass& m : model.masses) out.point_mass += m.mass;
  out.mass += out.point_mass;
  // Rounding errors of the difference are not mass.
  if (std::abs(out.other_mass) < 1e-9 * std::abs(out.mass)) out.other_mass = 0.0;
}

void sets(const FeModel& model, FeFacts& out) {
  const auto add = [&](const std::string& name, const char* kind, std::size_t size,
                       const std::set<int>& nodes) {
    out.sets.push_back({name, kind, static_cast<int>(size), static_cast<int>(nodes.size())});
  };
  for (const auto& [name, nodes] : model.node_sets)
    add(name, "nodes", nodes.size(), {nodes.begin(), nodes.end()});
  for (const auto& [name, elements] : model.element_sets) {
    std::set<int> nodes;
    for (const int e : elements) {
      const FeElement& element = model.elements[e];
      for (int k = 0; k < element_nodes(element.type); ++k) nodes.insert(element.nodes[k]);
    }
    add(name, "elements", elements.size(), nodes);
  }
  for (const auto& [name, faces] : model.surfaces) {
    std::set<int> nodes;
    for (const ElementFace& f : faces) {
      const FeElement& element = model.elements[f.element];
      const auto all = element_faces(element.type);
      if (f.face < 0 || f.face >= static_cast<int>(all.size())) continue;
      const FaceNodes& face = all[f.face];
      for (int k = 0; k < face.count; ++k) nodes.insert(element.nodes[face.nodes[k]]);
    }
    add(name, "surface", faces.size(), nodes);
  }
}

/// For a model with nodes.
std::pair<Vec3, Vec3> bounding_box(const FeModel& model) {
  Vec3 low = model.positions.front(), high = low;
  for (const Vec3& p : model.positions) low = low.cwiseMin(p), high = high.cwiseMax(p);
  return {low, high};
}

std::string material_name(const FeModel& model, std::size_t k) {
  return k < model.material_names.size() ? model.material_names[k] : fmt::format("{}", k + 1);
}

/// "set:BALL", "node:5": without the name of the interface.
std::string way_of(const InterfaceDescription& d) {
  return interface_text(d).substr(d.name.size() + 1);
}

/// Location of the first invalid element and the reason; empty if there is none.
std::string first_invalid(const FeFacts& f) {
  if (f.bad_elements.empty()) return "";
  return f.bad_mark.before(fmt::format("{} {}", f.bad_elements.front(), f.bad_reason));
}

std::string invalid_text(const FeFacts& f) {
  const std::size_t shown = std::min<std::size_t>(f.bad_elements.size(), 10);
  return fmt::format("\nWARNING: {} invalid: {}{}\n  {}\n",
                     plural(static_cast<long>(f.bad_elements.size()), "element is", "elements are"),
                     fmt::join(f.bad_elements.begin(),
                               f.bad_elements.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
                     shown < f.bad_elements.size() ? ", ..." : "", first_invalid(f));
}

std::string proposal_text(const ReduceProposal& p) {
  if (!p.obstacle.empty()) return fmt::format("\n`reduce` would refuse this: {}\n", p.obstacle);
  std::string text;
  if (!p.interfaces.empty()) {
    std::vector<std::string> ways;
    for (const InterfaceDescription& d : p.interfaces) ways.push_back(way_of(d));
    text += fmt::format("\nInterfaces that `reduce` takes together: {}\n", fmt::join(ways, ", "));
  }
  return text + fmt::format("\nTo reduce it, with the interfaces that you need\n  {}\n", p.command);
}

}  // namespace

std::vector<std::string> likely_units(const FeModel& model) {
  std::vector<std::string> out;
  if (model.materials.empty() || model.positions.empty()) return out;
  const auto [low, high] = bounding_box(model);
  for (const std::string& name : unit_system_names()) {
    const auto units = find_unit_system(name);
    if (!units || name == "si") continue;  // another name of m-kg-s
    const double size = (high - low).norm() * units->length;
    bool likely = size > 1e-3 && size < 50.0;
    for (std::size_t k = 0; k < model.materials.size(); ++k) {
      const Material& m = model.materials[k];
      const double E = m.young * units->pressure(), density = m.density * units->density();
      const bool usual = model.without_density.contains(static_cast<int>(k)) ||
                         (density > 50.0 && density < 25000.0);
      likely = likely && E > 1e8 && E < 2e12 && usual;
    }
    if (likely) out.push_back(name);
  }
  return out;
}

FeFacts fe_facts(const PartJob& job, const FeModel& model) {
  FeFacts out;
  out.nodes = model.places();
  std::map<std::string, int> types;
  for (const FeElement& e : model.elements) ++types[fe_element_name(e.type)];
  out.elements.assign(types.begin(), types.end());
  out.point_masses = static_cast<int>(model.masses.size());
  out.springs = static_cast<int>(model.springs.size());
  out.grounded_springs = static_cast<int>(std::count_if(
      model.springs.begin(), model.springs.end(), [](const Spring& s) { return s.nodes[1] < 0; }));
  out.equations = static_cast<int>(model.equations.size());
  std::set<int> supported;
  for (const Support& s : model.supports) supported.insert(s.node);
  out.supports = static_cast<int>(supported.size());
  if (model.matrices) {
    out.matrix_rows = static_cast<int>(model.matrices->dofs.size());
    out.matrix_damping = model.matrices->C.nonZeros() > 0;
  }
  if (!model.positions.empty()) std::tie(out.low, out.high) = bounding_box(model);
  measure(model, out);
  sets(model, out);
  const std::vector<char> arms = beam_arms(model);
  out.arms = static_cast<int>(std::count(arms.begin(), arms.end(), 1));
  for (std::size_t i = 0; i < model.spiders.size(); ++i) {
    if (arms[i] != 0) continue;
    const Spider& s = model.spiders[i];
    const std::string reference = s.reference >= 0 ? model.node_label(s.reference) : "";
    out.spiders.push_back({s.name, s.kind == Spider::Kind::rigid ? "rigid" : "mean", reference,
                           static_cast<int>(s.nodes.size())});
  }
  out.likely_units = likely_units(model);
  out.proposal = propose_reduction(job, model, out.likely_units);
  return out;
}

std::string fe_info_text(const PartJob& job, const FeModel& model) {
  const FeFacts f = fe_facts(job, model);
  std::string text = fmt::format("{}: finite-element model (numbers in the units of the file)\n",
                                 job.file.string());
  text += fmt::format("\n  nodes         {}\n", f.nodes);
  for (const auto& [type, count] : f.elements) text += fmt::format("  {:<12}  {}\n", type, count);
  if (f.matrix_rows > 0)
    text += fmt::format("  matrices      {} rows{}\n", f.matrix_rows,
                        f.matrix_damping ? ", with viscous damping" : "");
  if (f.point_masses > 0) text += fmt::format("  point masses  {}\n", f.point_masses);
  if (f.springs > 0)
    text += fmt::format(
        "  springs       {}{}\n", f.springs,
        f.grounded_springs == 0
            ? ""
            : fmt::format(", {} of them to the ground: `reduce` needs --grounded-springs ignore",
                          f.grounded_springs));
  if (f.equations > 0) text += fmt::format("  equations     {}\n", f.equations);
  if (f.arms > 0)
    text += fmt::format("  beam arms     at {}: ends of beams or bars away from them\n",
                        plural(f.arms, "node"));
  if (f.supports > 0)
    text += fmt::format("  supports      on {} nodes (a hint, not applied)\n", f.supports);
  text += fmt::format("  from          {}\n  to            {}\n", vector_text(f.low),
                      vector_text(f.high));
  if (!f.elements.empty()) {
    text += fmt::format("  volume        {:.8g}\n", f.volume);
    if (!model.materials.empty())
      text += fmt::format(
          "  mass          {:.8g}{}\n", f.mass,
          model.without_density.empty() ? "" : ", without that of materials that have no density");
  }
  if (!model.materials.empty()) {
    TextTable table({"material", "Young", "Poisson", "density", "mass"});
    for (std::size_t k = 0; k < model.materials.size(); ++k) {
      const Material& m = model.materials[k];
      const bool known = !model.without_density.contains(static_cast<int>(k));
      table.add({material_name(model, k), fmt::format("{:g}", m.young),
                 fmt::format("{:g}", m.poisson), known ? fmt::format("{:g}", m.density) : "-",
                 known ? fmt::format("{:.6g}", f.material_masses[k]) : "-"});
    }
    text += '\n' + table.text(2);
    if (f.point_mass != 0.0) text += fmt::format("  point masses: {:.6g}\n", f.point_mass);
    if (f.other_mass != 0.0)
      text +=
          fmt::format("  mass of sections besides that of their materials: {:.6g}\n", f.other_mass);
    if (!model.without_density.empty())
      text += "  density -: the file gives none; `reduce` needs one: --density RHO or NAME=RHO\n";
    text += f.likely_units.empty()
                ? "  no unit system makes these values those of a usual material\n"
                : fmt::format("  units: these values look like {}\n",
                              fmt::join(f.likely_units, " or "));
  } else if (!f.elements.empty()) {
    text += "\n  no material: give one with --material young,poisson,density\n";
  }
  if (!f.sets.empty()) {
    TextTable table({"set", "of", "size", "nodes"}, {1});
    for (const FeFacts::Set& s : f.sets)
      table.add({s.name, s.kind, std::to_string(s.size), std::to_string(s.nodes)});
    text += '\n' + table.text(2);
  }
  if (!f.spiders.empty()) {
    TextTable table({"spider", "kind", "reference", "nodes"}, {1, 2});
    for (const FeFacts::SpiderFacts& s : f.spiders)
      table.add({s.name, s.kind, s.reference, std::to_string(s.nodes)});
    text += '\n' + table.text(2);
  }
  if (!model.notes.empty()) {
    text += "\nIgnored in the file\n";
    for (const std::string& note : model.notes) text += "  - " + note + '\n';
  }
  text += f.bad_elements.empty() ? proposal_text(f.proposal) : invalid_text(f);
  return text;
}

std::string fe_info_json(const PartJob& job, const FeModel& model) {
  const FeFacts f = fe_facts(job, model);
  Json elements = Json::object(), materials = Json::array(), all_sets = Json::array(),
       spiders = Json::array();
  for (const auto& [type, count] : f.elements) elements[type] = count;
  for (std::size_t k = 0; k < model.materials.size(); ++k) {
    const Material& m = model.materials[k];
    const bool known = !model.without_density.contains(static_cast<int>(k));
    materials.push_back({{"name", material_name(model, k)},
                         {"young", m.young},
                         {"poisson", m.poisson},
                         {"density", known ? Json(m.density) : Json()},
                         {"mass", known ? Json(f.material_masses[k]) : Json()}});
  }
  for (const FeFacts::Set& s : f.sets)
    all_sets.push_back({{"name", s.name}, {"of", s.kind}, {"size", s.size}, {"nodes", s.nodes}});
  for (const FeFacts::SpiderFacts& s : f.spiders)
    spiders.push_back(
        {{"name", s.name}, {"kind", s.kind}, {"reference", s.reference}, {"nodes", s.nodes}});
  Json ways = Json::array();
  for (const InterfaceDescription& d : f.proposal.interfaces) ways.push_back(way_of(d));
  const Json json = {{"file", job.file.string()},
                     {"kind", "finite-element model"},
                     {"nodes", f.nodes},
                     {"elements", elements},
                     {"matrix_rows", f.matrix_rows},
                     {"matrix_damping", f.matrix_damping},
                     {"point_masses", f.point_masses},
                     {"springs", f.springs},
                     {"grounded_springs", f.grounded_springs},
                     {"equations", f.equations},
                     {"supported_nodes", f.supports},
                     {"low", json_vector(f.low)},
                     {"high", json_vector(f.high)},
                     {"volume", f.volume},
                     {"mass", f.mass},
                     {"point_mass", f.point_mass},
                     {"other_mass", f.other_mass},
                     {"materials", materials},
                     {"likely_units", f.likely_units},
                     {"sets", all_sets},
                     {"spiders", spiders},
                     {"beam_arms", f.arms},
                     {"possible_interfaces", ways},
                     {"command", f.proposal.command},
                     {"obstacle", f.proposal.obstacle},
                     {"bad_elements", f.bad_elements},
                     {"bad_reason", first_invalid(f)},
                     {"notes", model.notes},
                     {"files", model.files}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
