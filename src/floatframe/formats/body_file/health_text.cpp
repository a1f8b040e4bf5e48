#include "floatframe/formats/body_file/health_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/text_table.hpp"

namespace floatframe {
namespace {

constexpr std::size_t indent = 2;

std::string finite_number(double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : "-"; }
std::string percent(double x) { return fmt::format("{:.1f}", 100.0 * x); }
std::string small(double x) { return std::isfinite(x) ? fmt::format("{:.1e}", x) : "-"; }

std::string title(const std::string& text) { return '\n' + text + '\n'; }

std::string mass_text(const HealthReport& r) {
  TextTable table({"", "elements", "invariants", "difference"});
  const MassProperties &a = r.from_elements, &b = r.from_invariants;
  const auto add = [&](const std::string& name, double x, double y, double scale) {
    table.add({name, finite_number(x), finite_number(y),
               small(scale > 0.0 ? std::abs(x - y) / scale : 0.0)});
  };
  add("mass [kg]", a.mass, b.mass, a.mass);
  const double length = a.mass > 0.0 ? std::sqrt(std::max(0.0, a.J_origin.trace()) / a.mass) : 0.0;
  for (int i = 0; i < 3; ++i)
    add(fmt::format("centre of mass {} [m]", "xyz"[i]), a.centre[i], b.centre[i], length);
  const double J = a.J_origin.cwiseAbs().maxCoeff();
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}})
    add(fmt::format("inertia about the origin {}{} [kg m2]", "xyz"[i], "xyz"[j]), a.J_origin(i, j),
        b.J_origin(i, j), J);
  std::string text = title("Mass properties (part coordinates)") + table.text(indent);
  if (r.volume > 0.0)
    text += fmt::format(
        "  volume {:.6g} m3; volume x density, with point masses: {:.6g} kg ({:.1e} of the mass)\n",
        r.volume, r.volume_times_density,
        a.mass > 0.0 ? std::abs(r.volume_times_density / a.mass - 1.0) : 0.0);
  return text;
}

std::string rigid_text(const HealthReport& r) {
  std::string text = title("Rigid motions");
  if (r.rigid_eigenvalues) {
    text += "  six lowest eigenvalues / first elastic one:";
    for (int k = 0; k < 6; ++k) text += fmt::format(" {:.1e}", (*r.rigid_eigenvalues)[k]);
    text += '\n';
  }
  return text + fmt::format(
                    "  largest force of a rigid motion, |K R| / |K|: {:.1e}\n"
                    "  condition of the modal mass, each mode scaled: {:.1e}\n",
                    r.rigid_residual, r.modal_mass_condition);
}

std::string interfaces_text(const HealthReport& r) {
  if (r.interfaces.empty()) return "";
  TextTable table(
      {"interface", "kind", "nodes", "x [m]", "y [m]", "z [m]", "condition", "static error"}, {1});
  for (const InterfaceHealth& h : r.interfaces)
    table.add({h.name, h.kind, std::to_string(h.nodes), finite_number(h.p.x()),
               finite_number(h.p.y()), finite_number(h.p.z()),
               h.condition > 0.0 ? fmt::format("{:.1f}", h.condition) : "-",
               small(h.static_error)});
  std::string text = title("Interfaces") + table.text(indent);
  text +=
      "  static error: largest displacement error under six unit loads, of the largest "
      "displacement\n";
  if (!r.static_support.empty()) text += "  held for it: " + r.static_support + '\n';
  return text;
}

std::string modes_text(const HealthReport& r) {
  if (r.normal_modes.empty()) return "";
  TextTable table({"normal mode", "[Hz]", "x", "y", "z", "rx", "ry", "rz", "kept"}, {8});
  Vec6 sum = Vec6::Zero();
  for (const ModeHealth& m : r.normal_modes) {
    std::vector<std::string> row{m.name, hertz_text(m.frequency)};
    for (int k = 0; k < 6; ++k) row.push_back(percent(m.effective_mass[k]));
    row.push_back(m.kept ? "yes" : "no");
    table.add(std::move(row));
    if (m.kept) sum += m.effective_mass;
  }
  std::vector<std::string> last{"sum of those kept", ""};
  for (int k = 0; k < 6; ++k) last.push_back(percent(sum[k]));
  last.emplace_back();
  table.add(std::move(last));
  return title("Normal modes, effective mass [% of mass and inertia]") + table.text(indent);
}

std::string free_text(const HealthReport& r) {
  if (r.free_frequencies.empty()) return "";
  TextTable table({"free elastic mode", "full [Hz]", "reduced [Hz]", "error [%]"});
  int k = 0;
  for (const FrequencyPair& p : r.free_frequencies)
    table.add({std::to_string(++k), hertz_text(p.full), hertz_text(p.reduced),
               p.full > 0.0 ? fmt::format("{:+.4f}", 100.0 * p.relative_error()) : "-"});
  return title("Truncation: free frequencies of the reduced against the full model") +
         table.text(indent);
}

std::string damping_table(const HealthReport& r) {
  if (r.damping.free.empty()) return "";
  return title("Damping: fractions of critical [%] of the part's own modes") +
         own_damping_text(r.damping, 10, indent);
}

std::string stages_text(const HealthReport& r) {
  if (r.seconds.empty()) return "";
  TextTable table({"stage", "[s]"});
  double sum = 0.0;
  for (const auto& [stage, seconds] : r.seconds) {
    table.add({stage, fmt::format("{:.2f}", seconds)});
    sum += seconds;
  }
  table.add({"together", fmt::format("{:.2f}", sum)});
  return title(r.solver.empty() ? "Time" : "Time (solver: " + r.solver + ")") + table.text(indent);
}

std::string list_text(const std::string& heading, const std::vector<std::string>& lines,
                      const std::string& mark) {
  if (lines.empty()) return "";
  std::string text = title(heading);
  for (const std::string& line : lines) text += mark + line + '\n';
  return text;
}

}  // namespace

std::string hertz_text(double x) {
  if (!(x > 0.0)) return "-";
  return x < 1.0 ? fmt::format("{:.4g}", x) : fmt::format("{:.3f}", x);
}

std::string own_damping_text(const OwnDamping& damping, std::size_t most, std::size_t indent) {
  struct Held {
    const char* what;
    const std::vector<DampedMode>& modes;
  };
  std::vector<Held> columns;
  if (!damping.frame.empty()) columns.push_back({"frame held", damping.frame});
  columns.push_back({"free", damping.free});
  if (!damping.mounted.empty()) columns.push_back({"mounted", damping.mounted});
  std::vector<std::string> head{"mode"};
  std::size_t all = 0;
  for (const Held& c : columns) {
    head.push_back(fmt::format("{} [Hz]", c.what));
    head.emplace_back("[%]");
    all = std::max(all, c.modes.size());
  }
  TextTable table(head);
  for (std::size_t k = 0; k < std::min(all, most); ++k) {
    std::vector<std::string> row{std::to_string(k + 1)};
    for (const Held& c : columns) {
      const bool there = k < c.modes.size();
      row.push_back(there ? hertz_text(c.modes[k].frequency) : "-");
      row.push_back(there ? fmt::format("{:.4g}", 100.0 * c.modes[k].fraction) : "-");
    }
    table.add(std::move(row));
  }
  const std::string margin(indent, ' ');
  std::string text = table.text(indent);
  if (all > most) text += fmt::format("{}and {} more\n", margin, all - most);
  if (damping.mounted.empty())
    text += margin + (damping.interfaces ? "mounted: no mode is left with the interfaces held\n"
                                         : "mounted: where it is mounted is not known\n");
  return text;
}

std::string health_text(const HealthReport& r) {
  std::string text = fmt::format("{} nodes, {} elements, {} degrees of freedom -> {} modes\n",
                                 r.nodes, r.elements, r.dofs, r.modes);
  text += mass_text(r) + rigid_text(r) + interfaces_text(r) + modes_text(r) + free_text(r) +
          damping_table(r) + stages_text(r) + list_text("Ignored in the file", r.notes, "  - ");
  if (r.warnings.empty()) return text + "\nNo warnings.\n";
  return text + list_text(r.warnings.size() == 1
                              ? "WARNING: 1 thing to look at"
                              : fmt::format("WARNINGS: {} things to look at", r.warnings.size()),
                          r.warnings, "  ! ");
}

}  // namespace floatframe
