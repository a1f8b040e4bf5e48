#include "floatframe/formats/body_file/health_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
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

// JSON: one list of fields serves writing and reading.
using Json = nlohmann::ordered_json;

template <class IO>
void fields(IO& io, MassProperties& m) {
  io("mass_kg", m.mass);
  io("centre_m", m.centre);
  io("inertia_about_origin_kgm2", m.J_origin);
}

template <class IO>
void fields(IO& io, InterfaceHealth& h) {
  io("name", h.name);
  io("kind", h.kind);
  io("nodes", h.nodes);
  io("position_m", h.p);
  io("condition", h.condition);
  io("static_error", h.static_error);
}

template <class IO>
void fields(IO& io, ModeHealth& h) {
  io("name", h.name);
  io("frequency_Hz", h.frequency);
  io("effective_mass_fraction", h.effective_mass);
  io("kept", h.kept);
}

template <class IO>
void fields(IO& io, FrequencyPair& p) {
  io("full_Hz", p.full);
  io("reduced_Hz", p.reduced);
}

template <class IO>
void fields(IO& io, DampedMode& m) {
  io("frequency_Hz", m.frequency);
  io("fraction", m.fraction);
}

template <class IO>
void fields(IO& io, OwnDamping& d) {
  io("frame", d.frame);
  io("free", d.free);
  io("mounted", d.mounted);
  io("interfaces_known", d.interfaces);
}

template <class IO>
void fields(IO& io, std::pair<std::string, double>& p) {
  io("stage", p.first);
  io("seconds", p.second);
}

template <class IO>
void fields(IO& io, HealthReport& r) {
  io("nodes", r.nodes);
  io("elements", r.elements);
  io("degrees_of_freedom", r.dofs);
  io("modes", r.modes);
  io("from_elements", r.from_elements);
  io("from_invariants", r.from_invariants);
  io("volume_m3", r.volume);
  io("volume_times_density_kg", r.volume_times_density);
  io("rigid_eigenvalues", r.rigid_eigenvalues);
  io("rigid_residual", r.rigid_residual);
  io("modal_mass_condition", r.modal_mass_condition);
  io("rotary_inertia", r.rotary_inertia);
  io("normal_modes", r.normal_modes);
  io("free_frequencies", r.free_frequencies);
  io("damping", r.damping);
  io("interfaces", r.interfaces);
  io("static_support", r.static_support);
  io("solver", r.solver);
  io("seconds", r.seconds);
  io("notes", r.notes);
  io("warnings", r.warnings);
}

struct Writer {
  Json out = Json::object();
  template <class T>
  void operator()(const char* key, T& x) {
    out[key] = json(x);
  }
  static Json json(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }
  static Json json(int x) { return x; }
  static Json json(bool x) { return x; }
  static Json json(std::string& x) { return x; }
  template <int R, int C>
  static Json json(Eigen::Matrix<double, R, C>& x) {
    Json list = Json::array();
    for (Eigen::Index i = 0; i < R; ++i) {
      Json row = Json::array();
      for (Eigen::Index j = 0; j < C; ++j) row.push_back(json(x(i, j)));
      list.push_back(C == 1 ? row[0] : row);
    }
    return list;
  }
  template <class T>
  static Json json(std::optional<T>& x) {
    return x ? json(*x) : Json(nullptr);
  }
  template <class T>
  static Json json(std::vector<T>& list) {
    Json out = Json::array();
    for (T& x : list) out.push_back(json(x));
    return out;
  }
  template <class T>
  static Json json(T& object) {
    Writer w;
    fields(w, object);
    return w.out;
  }
};

struct Reader {
  const Json& in;
  template <class T>
  void operator()(const char* key, T& x) {
    const auto it = in.find(key);
    if (it == in.end()) return;
    if (!get(*it, x))
      throw InputError(ErrorCode::wrong_value, std::string("found a wrong value of '") + key + "'");
  }
  static bool get(const Json& j, double& x) {
    if (j.is_null()) x = std::numeric_limits<double>::quiet_NaN();
    if (j.is_number()) x = j.get<double>();
    return j.is_null() || j.is_number();
  }
  static bool get(const Json& j, int& x) {
    double number = 0.0;
    if (!j.is_number_integer() || !get(j, number) || std::abs(number) > 2e9) return false;
    x = static_cast<int>(number);
    return true;
  }
  static bool get(const Json& j, bool& x) {
    if (j.is_boolean()) x = j.get<bool>();
    return j.is_boolean();
  }
  static bool get(const Json& j, std::string& x) {
    if (j.is_string()) x = j.get<std::string>();
    return j.is_string();
  }
  template <int R, int C>
  static bool get(const Json& j, Eigen::Matrix<double, R, C>& x) {
    if (!j.is_array() || j.size() != R) return false;
    for (std::size_t i = 0; i < R; ++i) {
      const Json& row = j[i];
      if (C > 1 && (!row.is_array() || row.size() != C)) return false;
      for (std::size_t k = 0; k < C; ++k)
        if (!get(C > 1 ? row[k] : row,
                 x(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k))))
          return false;
    }
    return true;
  }
  template <class T>
  static bool get(const Json& j, std::optional<T>& x) {
    if (j.is_null()) return true;
    x.emplace();
    return get(j, *x);
  }
  template <class T>
  static bool get(const Json& j, std::vector<T>& list) {
    if (!j.is_array()) return false;
    for (const Json& item : j)
      if (!get(item, list.emplace_back())) return false;
    return true;
  }
  template <class T>
  static bool get(const Json& j, T& object) {
    if (!j.is_object()) return false;
    Reader r{j};
    fields(r, object);
    return true;
  }
};

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

std::string health_json(const HealthReport& report, int indent) {
  HealthReport copy = report;  // the list of fields is one for both directions
  return Writer::json(copy).dump(indent, ' ', false, Json::error_handler_t::replace);
}

HealthReport health_from_json(const std::string& text) {
  HealthReport out;
  std::string why;
  const Json json = read_json(text, why);
  if (!json.is_object())
    throw InputError(ErrorCode::missing, "found no object, expected a health report");
  Reader reader{json};
  fields(reader, out);
  return out;
}

}  // namespace floatframe
