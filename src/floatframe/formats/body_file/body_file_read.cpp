#include <nlohmann/json.hpp>
#include <set>

#include "floatframe/core/json_text.hpp"
#include "floatframe/core/printable.hpp"
#include "floatframe/core/regular_file.hpp"
#include "floatframe/formats/body_file/body_members.hpp"
#include "floatframe/formats/body_file/health_text.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& object, const char* key) {
  const auto it = object.find(key);
  return it != object.end() && it->is_string() ? it->get<std::string>() : std::string();
}

/// CSR of n rows and columns, written as data, indices, indptr.
SparseRows read_sparse(ArrayReader& arrays, const std::string& name, Eigen::Index n) {
  const Eigen::Index entries = arrays.length(name + "_data");
  const VecX data = arrays.list(name + "_data", entries);
  const std::vector<int> columns = arrays.integers(name + "_indices", std::nullopt, n);
  const std::vector<int> starts = arrays.integers(name + "_indptr", std::nullopt, entries + 1);
  SparseRows out(n, n);
  const bool valid = columns.size() == static_cast<std::size_t>(entries) &&
                     starts.size() == static_cast<std::size_t>(n) + 1 && starts.front() == 0 &&
                     starts.back() == entries && std::is_sorted(starts.begin(), starts.end());
  if (!valid) {
    arrays.error(
        ErrorCode::wrong_count, name + "_indptr",
        "found {} rows for {} values in {} columns, expected the {} rows of a sparse matrix",
        starts.empty() ? 0 : starts.size() - 1, entries, columns.size(), n);
    return out;
  }
  std::vector<Eigen::Triplet<double>> triplets;
  for (Eigen::Index r = 0; r < n; ++r)
    for (int k = starts[r]; k < starts[r + 1]; ++k)
      triplets.emplace_back(static_cast<int>(r), columns[k], data[k]);
  out.setFromTriplets(triplets.begin(), triplets.end());
  return out;
}

class BodyReader {
 public:
  BodyReader(std::string_view bytes, const std::string& name)
      : name_(name), members_(read_zip(bytes, name)), arrays_(members_, name, errors_) {}

  BodyFile read() {
    header();
    body_matrices(arrays_, body(), static_cast<Eigen::Index>(body().mode_names.size()));
    const Eigen::Index nm = body().modes();
    marker_matrices(arrays_, body().nodes, nm);
    body().second_order =
        read_second_order(arrays_, nm, static_cast<Eigen::Index>(body().nodes.size()));
    body().turning = read_turning(arrays_, nm);
    surface();
    if (arrays_.has("projection_p")) projection();
    errors_.throw_if_any();
    check_body_numbers(out_, header_, arrays_, errors_, name_);
    errors_.throw_if_any();
    return std::move(out_);
  }

 private:
  FlexibleBody& body() { return out_.part.body; }
  template <class... Args>
  void error(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) {
    errors_.add(code, {name_, 0, 0},
                "member 'header.json': " + fmt::format(text, std::forward<Args>(args)...));
  }
  template <class... Args>
  [[noreturn]] void stop(ErrorCode code, fmt::format_string<Args...> text, Args&&... args) const {
    throw InputError(code, {name_, 0, 0}, fmt::format(text, std::forward<Args>(args)...));
  }

  /// The rest cannot be read without it.
  void header() {
    const auto it = std::find_if(members_.begin(), members_.end(),
                                 [](const ZipMember& m) { return m.name == "header.json"; });
    if (it == members_.end())
      stop(ErrorCode::wrong_file, "this is not a body file (it has no member 'header.json')");
    std::string why;
    const Json json = read_json(it->content, why);
    if (json.is_discarded())
      stop(ErrorCode::wrong_file, "this is not a body file (member 'header.json' is no header: {})",
           why);
    if (!json.is_object() || text_of(json, "format") != "floatframe body")
      stop(ErrorCode::wrong_file,
           "this is not a body file (member 'header.json' does not say format 'floatframe body')");
    const auto version = json.find("format_version");
    if (version == json.end() || *version != body_file_version)
      stop(ErrorCode::mismatch,
           "member 'header.json': found format version {}, this program reads version {} (the file "
           "was written by Floatframe {})",
           version == json.end() ? "none" : json_excerpt(*version), body_file_version,
           excerpt(text_of(json, "floatframe")));
    if (const auto units = json.find("units"); units != json.end() && *units != body_file_units)
      error(ErrorCode::wrong_value,
            "found the units {}, expected \"{}\": all members are in SI units",
            json_excerpt(*units), body_file_units);
    modes(json);
    if (const auto n = json.find("equal_modes_left_out"); n != json.end()) {
      if (n->is_number_integer() && *n >= 0 && *n <= 1000)
        body().equal_left_out = n->get<int>();
      else
        error(ErrorCode::out_of_range,
              "found equal_modes_left_out {}, expected a whole number from 0 to 1000",
              json_excerpt(*n));
    }
    markers(json);
    const std::string mass_model = text_of(json, "mass_model");
    const auto model = std::find(body_mass_models.begin(), body_mass_models.end(), mass_model);
    if (model == body_mass_models.end())
      error(ErrorCode::wrong_value,
            "found the mass model '{}', expected isoparametric, six_dof or hermite",
            excerpt(mass_model));
    else
      body().mass_model = static_cast<MassModel>(model - body_mass_models.begin());
    if (const auto from = json.find("provenance"); from != json.end() && from->is_object())
      provenance(*from, text_of(json, "floatframe"));
    if (const auto stress = json.find("stress"); stress != json.end() && stress->is_object())
      header_.stress = {texts_of(*stress, "groups"), texts_of(*stress, "beams")};
    try {
      if (const auto health = json.find("health"); health != json.end())
        out_.part.health = health_from_json(health->dump());
    } catch (const InputError& damage) {
      error(damage.errors().front().code, "health: {}", damage.what());
    }
  }

  void modes(const Json& json) {
    const auto list = json.find("modes");
    if (list == json.end() || !list->is_array())
      return error(ErrorCode::missing, "found no list of 'modes', expected one entry per mode");
    for (const Json& mode : *list) {
      body().mode_names.push_back(name_of(mode, "mode"));
      const Json f = mode.is_object() ? mode.value("frequency_Hz", Json()) : Json();
      if (!f.is_null() && !f.is_number())
        error(ErrorCode::out_of_range,
              "found the frequency_Hz {} of mode {}, expected a number [Hz]", json_excerpt(f),
              header_.frequencies.size() + 1);
      header_.frequencies.push_back(f.is_number() ? f.get<double>() : -1.0);
    }
  }

  void markers(const Json& json) {
    const auto list = json.find("markers");
    if (list == json.end() || !list->is_array())
      return error(ErrorCode::missing, "found no list of 'markers', expected one");
    std::set<std::string> names;
    for (const Json& marker : *list) {
      const std::string name = name_of(marker, "marker");
      body().nodes.emplace_back().name = name;
      if (name.empty() || !names.insert(name).second)
        error(ErrorCode::contradiction,
              "found the marker name '{}', expected names that are not empty and differ",
              excerpt(name));
      followers(marker, name);
      interface_of(marker);
    }
  }

  /// Missing entries have no name; names are for tables.
  static std::vector<std::string> texts_of(const Json& object, const char* key) {
    std::vector<std::string> out;
    if (const auto list = object.find(key); list != object.end() && list->is_array())
      for (const Json& text : *list)
        out.push_back(text.is_string() ? printable(text.get<std::string>()) : std::string());
    return out;
  }

  /// As in model files: no control characters, which a terminal would interpret.
  std::string name_of(const Json& object, const char* what) {
    std::string name = text_of(object, "name");
    if (printable(name) != name)
      error(ErrorCode::wrong_value,
            "found the {} name '{}', expected one without control characters", what,
            printable(excerpt(name)));
    return name;
  }

  /// The degrees of freedom of an interface; all of them in files of earlier programs.
  void interface_of(const Json& marker) {
    if (!marker.is_object()) return;
    const auto given = marker.find("interface"), dofs = marker.find("dofs");
    InterfaceDofs at{static_cast<int>(body().nodes.size()) - 1, 0};
    if (given != marker.end() && *given == true) at.mask = 63u;
    if (dofs != marker.end() && dofs->is_array()) {
      at.mask = 0;
      for (unsigned k = 0; k < 6; ++k)
        if (std::find(dofs->begin(), dofs->end(), Json(interface_directions[k])) != dofs->end())
          at.mask |= 1u << k;
    }
    if (at.mask != 0) body().interfaces.push_back(at);
  }

  /// Points of the surface that move with a marker.
  void followers(const Json& marker, const std::string& name) {
    std::vector<std::int64_t>& list = header_.moves_with.emplace_back();
    const auto given = marker.is_object() ? marker.find("moves_with") : marker.end();
    if (!marker.is_object() || given == marker.end()) return;
    bool right = given->is_array();
    for (const Json& point : *given) {
      right = right && point.is_number_integer();
      if (right) list.push_back(point.get<std::int64_t>());
    }
    if (right) return;
    list.clear();
    error(ErrorCode::wrong_count,
          "found moves_with {} of marker '{}', expected a list of surface points",
          json_excerpt(*given), excerpt(name));
  }

  void provenance(const Json& json, const std::string& version) {
    Provenance& from = out_.provenance;
    from.source = text_of(json, "source");
    from.source_hash = text_of(json, "source_hash");
    from.units = text_of(json, "units");
    from.date = text_of(json, "date");
    from.version = version;
    if (const auto list = json.find("options"); list != json.end() && list->is_array())
      for (const Json& pair : *list)
        if (pair.is_array() && pair.size() == 2 && pair[0].is_string() && pair[1].is_string())
          from.options.emplace_back(pair[0].get<std::string>(), pair[1].get<std::string>());
    if (const auto list = json.find("files"); list != json.end() && list->is_array())
      for (const Json& entry : *list)
        from.files.emplace_back(text_of(entry, "file"), text_of(entry, "hash"));
  }

  void surface() {
    ReducedPart& part = out_.part;
    part.surface.nodes = arrays_.integers("surface_nodes", std::nullopt, 2147483647);
    const Eigen::Index n = arrays_.length("surface_nodes"), nm = body().modes();
    part.surface.triangles = arrays_.integers<3>("surface_triangles", n);
    part.surface.lines = arrays_.integers<2>("surface_lines", n);
    arrays_.points("surface_positions", part.surface_positions, n);
    // Without modes there are no data to miss; earlier versions wrote the array empty then.
    part.surface_modes =
        nm > 0 ? arrays_.grouped("surface_modes", n, 3, nm) : MatX(MatX::Zero(3 * n, 0));
    body().stress =
        read_stress(arrays_, nm, part.surface.nodes, part.surface_positions, header_.stress);
  }

  void projection() {
    auto data = std::make_shared<ProjectionData>();
    const Eigen::Index n = arrays_.length("projection_p"), nm = body().modes();
    projection_matrices(arrays_, *data, n, nm);
    if (arrays_.has("projection_X_theta"))
      data->M_6 = read_sparse(arrays_, "projection_M_6", 6 * n);
    else
      data->M_s = read_sparse(arrays_, "projection_M_s", n);
    read_projection_second_order(arrays_, nm, *data);
    body().projection = data;
  }

  std::string name_;
  ErrorList errors_;
  BodyHeader header_;
  std::vector<ZipMember> members_;
  ArrayReader arrays_;
  BodyFile out_;
};

}  // namespace

BodyFile read_body_bytes(std::string_view bytes, const std::string& name) {
  return BodyReader(bytes, name).read();
}

BodyFile read_body_file(const std::filesystem::path& file) {
  return read_body_bytes(regular_file(file), file.string());
}

bool is_body_file(const std::filesystem::path& file) {
  std::string beginning;
  return read_regular_beginning(file, 2, beginning).empty() && beginning == "PK";
}

}  // namespace floatframe
