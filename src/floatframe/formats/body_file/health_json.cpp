// One list of fields serves writing and reading.
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/formats/body_file/health_text.hpp"

namespace floatframe {
namespace {

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
