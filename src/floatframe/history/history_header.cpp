#include "floatframe/history/history_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/simulation/state_layout.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t most_coordinates = 10'000'000;

Json origin_json(const HistoryOrigin& o) {
  Json files = Json::object();
  for (const auto& [file, hash] : o.files) files[file] = hash;
  return {{"file", o.model_file},
          {"file_from_here", o.from_here},
          {"settings", o.settings},
          {"files", std::move(files)},
          {"text", o.text}};
}

Json body_json(const HistoryBody& b) {
  return {{"name", b.name},   {"mass", b.mass},
          {"modes", b.modes}, {"frequencies_Hz", b.frequencies},
          {"pose", b.pose},   {"amplitudes", b.amplitudes},
          {"rates", b.rates}, {"shape", b.shape}};
}

Json health_column_json(const HistoryHealth& column) {
  Json json{{"name", column.name}, {"unit", column.unit}, {"group", column.group}};
  if (!column.body.empty()) json.update({{"body", column.body}, {"size_m", column.size}});
  return json;
}

/// Values of a JSON object by key, each of the type that is asked for.
class HeaderReader {
 public:
  explicit HeaderReader(const Json& object, std::string path = {})
      : object_(object), path_(std::move(path)) {
    if (!object.is_object())
      refuse(ErrorCode::wrong_value, path_,
             "found " + json_excerpt(object) + ", expected an object");
  }

  bool has(const char* key) const { return object_.contains(key); }
  const Json& value(const char* key) const {
    const auto it = object_.find(key);
    if (it == object_.end()) refuse(ErrorCode::missing, path_ + key, "it is missing");
    return *it;
  }
  template <class T>
  T get(const char* key) const {
    return as<T>(value(key), path_ + key);
  }
  template <class T>
  std::vector<T> list(const char* key) const {
    std::vector<T> out;
    for (const Json& item : items(key)) out.push_back(as<T>(item, path_ + key));
    return out;
  }
  const Json& items(const char* key) const {
    const Json& list = value(key);
    if (!list.is_array())
      refuse(ErrorCode::wrong_value, path_ + key,
             "found " + json_excerpt(list) + ", expected a list");
    return list;
  }
  HeaderReader object(const char* key) const { return HeaderReader(value(key), path_ + key + '.'); }
  HeaderReader element(const char* key, const Json& item) const {
    return HeaderReader(item, path_ + key + '.');
  }
  /// A whole number from `low` to `high`.
  int whole(const char* key, int low, std::uint64_t high) const {
    return whole(value(key), path_ + key, low, high);
  }
  static int whole(const Json& x, const std::string& path, int low, std::uint64_t high) {
    const auto holds = [&] {
      if (x.is_number_unsigned() && x.get<std::uint64_t>() > high) return false;
      return x.is_number_integer() && x.get<std::int64_t>() >= low;
    };
    if (!holds())
      refuse(ErrorCode::out_of_range, path,
             fmt::format("found {}, expected a whole number from {} to {}", json_excerpt(x), low,
                         high));
    return static_cast<int>(x.get<std::int64_t>());
  }
  [[noreturn]] static void refuse(ErrorCode code, const std::string& path,
                                  const std::string& what) {
    throw InputError(code,
                     fmt::format("the header is not one of a result file: {}: {}", path, what));
  }

 private:
  template <class T>
  static T as(const Json& x, const std::string& path) {
    if constexpr (std::is_same_v<T, std::string>) {
      if (!x.is_string())
        refuse(ErrorCode::wrong_value, path, "found " + json_excerpt(x) + ", expected a text");
    } else {
      if (!x.is_number())
        refuse(ErrorCode::out_of_range, path, "found " + json_excerpt(x) + ", expected a number");
    }
    return x.get<T>();
  }

  const Json& object_;
  std::string path_;
};

void require_word(const std::string& found, const char* key, std::span<const char* const> words) {
  if (std::find(words.begin(), words.end(), found) == words.end())
    HeaderReader::refuse(ErrorCode::wrong_value, key,
                         "found '" + excerpt(found) + "', expected " + alternatives(words));
}

/// Ascending, from 0 to below `limit`.
std::vector<int> coordinate_list(const HeaderReader& in, const char* key, int limit) {
  std::vector<int> out;
  for (const Json& item : in.items(key))
    out.push_back(HeaderReader::whole(item, key, out.empty() ? 0 : out.back() + 1,
                                      static_cast<std::uint64_t>(limit)));
  if (!out.empty() && out.back() >= limit)
    HeaderReader::refuse(
        ErrorCode::out_of_range, key,
        fmt::format("found {}, expected a coordinate below {}", out.back(), limit));
  return out;
}

void read_groups(const HeaderReader& in, HistoryHeader& h) {
  for (const Json& item : in.items("groups")) {
    const HeaderReader g = in.element("groups", item);
    h.groups.push_back({g.get<std::string>("name"),
                        static_cast<std::size_t>(g.whole("first", 0, most_coordinates)),
                        static_cast<std::size_t>(g.whole("count", 0, most_coordinates))});
    if (h.groups.back().first != h.columns)
      HeaderReader::refuse(ErrorCode::contradiction, "groups",
                           "columns that do not follow each other");
    h.columns += h.groups.back().count;
    if (h.columns > most_coordinates)
      HeaderReader::refuse(ErrorCode::wrong_count, "groups", "there are too many columns");
  }
  const auto expect = [&](const char* name, std::size_t count, bool needed) {
    const HistoryGroup* g = h.find(name);
    if (!g && !needed) return;
    if (!g || g->count != count)
      HeaderReader::refuse(
          ErrorCode::wrong_count, "groups",
          fmt::format("found {} columns of '{}', expected {}", g ? g->count : 0, name, count));
  };
  if (h.groups.empty() || h.groups.front().name != "time")
    HeaderReader::refuse(ErrorCode::wrong_value, "groups", "the first is not 'time'");
  expect("time", 1, true);
  expect("q", h.q.size(), true);
  expect("v", h.v.size(), true);
  expect("accelerations", h.v.size(), false);
}

void read_bodies(const HeaderReader& in, HistoryHeader& h) {
  const auto inside = [&](const char* what, const char* group, int first, std::size_t count) {
    const HistoryGroup* g = h.find(group);
    if (first < 0) return;
    if (!g || static_cast<std::size_t>(first) < g->first ||
        static_cast<std::size_t>(first) + count > g->first + g->count)
      HeaderReader::refuse(ErrorCode::out_of_range, "bodies",
                           fmt::format("'{}' are columns outside of '{}'", what, group));
  };
  for (const Json& item : in.items("bodies")) {
    const HeaderReader b = in.element("bodies", item);
    HistoryBody body;
    body.name = b.get<std::string>("name");
    body.mass = b.get<double>("mass");
    body.modes = b.list<std::string>("modes");
    body.frequencies = b.list<double>("frequencies_Hz");
    body.pose = b.whole("pose", -1, most_coordinates);
    body.amplitudes = b.whole("amplitudes", -1, most_coordinates);
    body.rates = b.whole("rates", -1, most_coordinates);
    body.shape = b.whole("shape", -1, most_coordinates);
    if (body.frequencies.size() != body.modes.size())
      HeaderReader::refuse(ErrorCode::wrong_count, "bodies.frequencies_Hz",
                           "not one for each mode");
    if (body.shape >= static_cast<int>(h.shapes.size()))
      HeaderReader::refuse(ErrorCode::not_found, "bodies.shape", "there is no such shape");
    inside("pose", "poses", body.pose, 7);
    inside("amplitudes", "q", body.amplitudes, body.modes.size());
    inside("rates", "v", body.rates, body.modes.size());
    h.bodies.push_back(std::move(body));
  }
}

HistoryHealth health_column(const HeaderReader& in, const Json& item) {
  const HeaderReader c = in.element("health", item);
  HistoryHealth column{
      c.get<std::string>("name"), c.get<std::string>("unit"), c.get<std::string>("group"), {}, 0.0};
  if (c.has("body")) {
    column.body = c.get<std::string>("body");
    column.size = c.get<double>("size_m");
  }
  return column;
}

/// Files of runs that were not watched may do without the key.
void read_health(const HeaderReader& in, HistoryHeader& h) {
  if (in.has("health"))
    for (const Json& item : in.items("health")) h.health.push_back(health_column(in, item));
  const HistoryGroup* g = h.find(health_group);
  if ((g ? g->count : 0) != h.health.size())
    HeaderReader::refuse(
        ErrorCode::wrong_count, "health",
        fmt::format("found {} columns, expected {}", h.health.size(), g ? g->count : 0));
}

void read_arrays(const HeaderReader& in, HistoryHeader& h) {
  for (const Json& item : in.items("shapes")) {
    const HeaderReader shape = in.element("shapes", item);
    h.shapes.push_back({shape.list<std::string>("nodes")});
    if (item.contains("color")) h.shapes.back().color = shape.get<std::string>("color");
  }
  for (const Json& item : in.items("arrays")) {
    const HeaderReader a = in.element("arrays", item);
    HistoryArray array{a.get<std::string>("name"), a.get<std::string>("type"), {}};
    if (array.type != "f32" && array.type != "f64" && array.type != "u32")
      HeaderReader::refuse(ErrorCode::wrong_value, "arrays.type",
                           "found '" + excerpt(array.type) + "', expected f32, f64 or u32");
    for (const Json& n : a.items("shape"))
      array.shape.push_back(
          static_cast<std::uint64_t>(HeaderReader::whole(n, "arrays.shape", 0, 2'000'000'000)));
    if (array.shape.size() > 4 || (array_bytes(array) == 0 && [&] {
          for (const std::uint64_t n : array.shape)
            if (n == 0) return false;
          return true;
        }()))
      HeaderReader::refuse(ErrorCode::too_large, "arrays.shape", "it is too large");
    h.arrays.push_back(std::move(array));
  }
}

}  // namespace

const HistoryGroup* HistoryHeader::find(std::string_view name) const noexcept {
  for (const HistoryGroup& g : groups)
    if (g.name == name) return &g;
  return nullptr;
}

std::uint64_t array_bytes(const HistoryArray& array) noexcept {
  std::uint64_t bytes = array.type == "f64" ? 8 : 4;
  for (const std::uint64_t n : array.shape) {
    if (n > 0 && bytes > (std::uint64_t{1} << 62) / n) return 0;
    bytes *= n;
  }
  return bytes;
}

std::string header_json(const HistoryHeader& h) {
  Json j;
  j["format"] = "floatframe states";
  j["units"] = "SI (m, kg, s, rad)";
  j["floatframe"] = h.origin.program;
  j["library"] = h.origin.library;
  j["model"] = h.model;
  j["model_hash"] = h.model_hash;
  j["origin"] = origin_json(h.origin);
  j["coordinates"] = h.coordinates;
  j["inertia"] = h.inertia;
  j["step_s"] = h.step;
  j["duration_s"] = h.duration;
  j["output_interval_s"] = h.output_interval;
  j["configurations"] = h.configurations;
  j["velocities"] = h.velocities;
  j["q"] = h.q;
  j["v"] = h.v;
  j["v_of"] = h.owners;
  j["groups"] = Json::array();
  for (const HistoryGroup& g : h.groups)
    j["groups"].push_back({{"name", g.name}, {"first", g.first}, {"count", g.count}});
  j["shapes"] = Json::array();
  for (const HistoryShape& s : h.shapes) {
    j["shapes"].push_back({{"nodes", s.nodes}});
    if (!s.color.empty()) j["shapes"].back()["color"] = s.color;
  }
  j["arrays"] = Json::array();
  for (const HistoryArray& a : h.arrays)
    j["arrays"].push_back({{"name", a.name}, {"type", a.type}, {"shape", a.shape}});
  j["bodies"] = Json::array();
  for (const HistoryBody& b : h.bodies) j["bodies"].push_back(body_json(b));
  j["health"] = Json::array();
  for (const HistoryHealth& column : h.health) j["health"].push_back(health_column_json(column));
  return j.dump(1, ' ', false, Json::error_handler_t::replace);
}

HistoryHeader header_from_json(std::string_view text) {
  std::string why;
  const Json json = read_json(text, why);
  if (json.is_discarded())
    throw InputError(ErrorCode::wrong_file, "the header is not JSON: " + why);
  const HeaderReader in(json);
  if (in.get<std::string>("format") != "floatframe states")
    HeaderReader::refuse(ErrorCode::wrong_value, "format", "expected 'floatframe states'");
  HistoryHeader h;
  h.origin.program = in.get<std::string>("floatframe");
  h.origin.library = in.get<std::string>("library");
  h.model = in.get<std::string>("model");
  h.model_hash = in.get<std::string>("model_hash");
  const HeaderReader origin = in.object("origin");
  h.origin.model_file = origin.get<std::string>("file");
  h.origin.from_here = origin.get<std::string>("file_from_here");
  h.origin.settings = origin.list<std::string>("settings");
  h.origin.text = origin.get<std::string>("text");
  if (!origin.value("files").is_object())
    HeaderReader::refuse(ErrorCode::wrong_value, "origin.files", "not an object");
  for (const auto& [file, hash] : origin.value("files").items()) {
    if (!hash.is_string())
      HeaderReader::refuse(ErrorCode::wrong_value, "origin.files", "expected texts");
    h.origin.files[file] = hash.get<std::string>();
  }
  h.coordinates = in.get<std::string>("coordinates");
  h.inertia = in.get<std::string>("inertia");
  require_word(h.coordinates, "coordinates", rules::coordinates);
  require_word(h.inertia, "inertia", rules::inertia_methods);
  h.step = in.get<double>("step_s");
  h.duration = in.get<double>("duration_s");
  h.output_interval = in.get<double>("output_interval_s");
  h.configurations = in.whole("configurations", 0, most_coordinates);
  h.velocities = in.whole("velocities", 0, most_coordinates);
  h.q = coordinate_list(in, "q", h.configurations);
  h.v = coordinate_list(in, "v", h.velocities);
  h.owners = in.list<std::string>("v_of");
  if (h.owners.size() != h.v.size())
    HeaderReader::refuse(ErrorCode::wrong_count, "v_of", "not one for each velocity");
  read_groups(in, h);
  read_arrays(in, h);
  read_bodies(in, h);
  read_health(in, h);
  return h;
}

}  // namespace floatframe
