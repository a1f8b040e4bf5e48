#include "floatframe/history/history_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/run/state_layout.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::uint64_t most_coordinates = 10'000'000;

// The fields of a header, once each: `f` writes or reads them.

constexpr auto origin_fields = [](auto& f, auto& o) {
  f("file", o.model_file);
  f("file_from_here", o.from_here);
  f("settings", o.settings);
  f("files", o.files);
  f("text", o.text);
};
constexpr auto group_fields = [](auto& f, auto& g) {
  f("name", g.name);
  f("first", g.first);
  f("count", g.count);
};
constexpr auto shape_fields = [](auto& f, auto& s) {
  f("nodes", s.nodes);
  f.optional("color", s.color);
};
constexpr auto array_fields = [](auto& f, auto& a) {
  f("name", a.name);
  f("type", a.type);
  f("shape", a.shape);
};
constexpr auto body_fields = [](auto& f, auto& b) {
  f("name", b.name);
  f("mass", b.mass);
  f("modes", b.modes);
  f("frequencies_Hz", b.frequencies);
  f("pose", b.pose);
  f("amplitudes", b.amplitudes);
  f("rates", b.rates);
  f("shape", b.shape);
};
constexpr auto health_fields = [](auto& f, auto& column) {
  f("name", column.name);
  f("unit", column.unit);
  f("group", column.group);
  if (f.optional("body", column.body)) f("size_m", column.size);
};
constexpr auto header_fields = [](auto& f, auto& h) {
  f("floatframe", h.origin.program);
  f("library", h.origin.library);
  f("model", h.model);
  f("model_hash", h.model_hash);
  f.object("origin", h.origin, origin_fields);
  f("coordinates", h.coordinates);
  f("inertia", h.inertia);
  f("step_s", h.step);
  f("duration_s", h.duration);
  f("output_interval_s", h.output_interval);
  f("configurations", h.configurations, 0);
  f("velocities", h.velocities, 0);
  f.coordinates("q", h.q, h.configurations);
  f.coordinates("v", h.v, h.velocities);
  f("v_of", h.owners);
  f.objects("groups", h.groups, group_fields);
  f.objects("shapes", h.shapes, shape_fields);
  f.objects("arrays", h.arrays, array_fields);
  f.objects("bodies", h.bodies, body_fields);
  // Files of runs without range checks may lack the key.
  if (f.has("health")) f.objects("health", h.health, health_fields);
};

struct HeaderWriter {
  Json json = Json::object();

  bool has(const char*) const { return true; }
  template <class T>
  void operator()(const char* key, const T& value, int = 0) {
    json[key] = value;
  }
  bool optional(const char* key, const std::string& text) {
    if (!text.empty()) json[key] = text;
    return !text.empty();
  }
  void coordinates(const char* key, const std::vector<int>& list, int) { json[key] = list; }
  template <class T, class Walk>
  void object(const char* key, const T& value, Walk walk) {
    HeaderWriter inner;
    walk(inner, value);
    json[key] = std::move(inner.json);
  }
  template <class T, class Walk>
  void objects(const char* key, const std::vector<T>& list, Walk walk) {
    Json all = Json::array();
    for (const T& value : list) {
      HeaderWriter inner;
      walk(inner, value);
      all.push_back(std::move(inner.json));
    }
    json[key] = std::move(all);
  }
};

/// Values of a JSON object by key, each with the requested type.
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

  void operator()(const char* key, std::string& text) const { text = get<std::string>(key); }
  void operator()(const char* key, double& number) const { number = get<double>(key); }
  /// A whole number; -1 means none.
  void operator()(const char* key, int& number, int low = -1) const {
    number = whole(value(key), path_ + key, low, most_coordinates);
  }
  void operator()(const char* key, std::size_t& number) const {
    number = static_cast<std::size_t>(whole(value(key), path_ + key, 0, most_coordinates));
  }
  template <class T>
  void operator()(const char* key, std::vector<T>& list) const {
    for (const Json& item : items(key)) list.push_back(as<T>(item, path_ + key));
  }
  void operator()(const char* key, std::vector<std::uint64_t>& list) const {
    for (const Json& n : items(key))
      list.push_back(static_cast<std::uint64_t>(whole(n, path_ + key, 0, 2'000'000'000)));
  }
  void operator()(const char* key, std::map<std::string, std::string>& texts) const {
    if (!value(key).is_object()) refuse(ErrorCode::wrong_value, path_ + key, "not an object");
    for (const auto& [name, text] : value(key).items()) {
      if (!text.is_string()) refuse(ErrorCode::wrong_value, path_ + key, "expected texts");
      texts[name] = text.get<std::string>();
    }
  }
  bool optional(const char* key, std::string& text) const {
    if (has(key)) text = get<std::string>(key);
    return has(key);
  }
  /// Ascending, from 0 to below `limit`.
  void coordinates(const char* key, std::vector<int>& list, int limit) const {
    for (const Json& item : items(key))
      list.push_back(
          whole(item, key, list.empty() ? 0 : list.back() + 1, static_cast<std::uint64_t>(limit)));
    if (!list.empty() && list.back() >= limit)
      refuse(ErrorCode::out_of_range, key,
             fmt::format("found {}, expected a coordinate below {}", list.back(), limit));
  }
  template <class T, class Walk>
  void object(const char* key, T& place, Walk walk) const {
    const HeaderReader inner(value(key), path_ + key + '.');
    walk(inner, place);
  }
  template <class T, class Walk>
  void objects(const char* key, std::vector<T>& list, Walk walk) const {
    for (const Json& item : items(key)) {
      const HeaderReader inner(item, path_ + key + '.');
      walk(inner, list.emplace_back());
    }
  }
  [[noreturn]] static void refuse(ErrorCode code, const std::string& path,
                                  const std::string& what) {
    throw InputError(code,
                     fmt::format("the header is not one of a result file: {}: {}", path, what));
  }

 private:
  const Json& items(const char* key) const {
    const Json& list = value(key);
    if (!list.is_array())
      refuse(ErrorCode::wrong_value, path_ + key,
             "found " + json_excerpt(list) + ", expected a list");
    return list;
  }
  /// From `low` to `high`.
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
  template <class T>
  static T as(const Json& x, const std::string& path) {
    if constexpr (std::is_same_v<T, std::string>) {
      if (!x.is_string())
        refuse(ErrorCode::wrong_value, path, "found " + json_excerpt(x) + ", expected a text");
    } else {
      if (!x.is_number())
        refuse(ErrorCode::not_a_number, path, "found " + json_excerpt(x) + ", expected a number");
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

void check_groups(HistoryHeader& h) {
  for (const HistoryGroup& g : h.groups) {
    if (g.first != h.columns)
      HeaderReader::refuse(ErrorCode::contradiction, "groups",
                           "columns that do not follow each other");
    h.columns += g.count;
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

void check_arrays(const HistoryHeader& h) {
  for (const HistoryArray& array : h.arrays) {
    if (array.type != "f32" && array.type != "f64" && array.type != "u32")
      HeaderReader::refuse(ErrorCode::wrong_value, "arrays.type",
                           "found '" + excerpt(array.type) + "', expected f32, f64 or u32");
    const bool nothing = std::find(array.shape.begin(), array.shape.end(), 0u) != array.shape.end();
    if (array.shape.size() > 4 || (array_bytes(array) == 0 && !nothing))
      HeaderReader::refuse(ErrorCode::too_large, "arrays.shape", "it is too large");
  }
}

void check_bodies(const HistoryHeader& h) {
  const auto inside = [&](const char* what, const char* group, int first, std::size_t count) {
    const HistoryGroup* g = h.find(group);
    if (first < 0) return;
    if (!g || static_cast<std::size_t>(first) < g->first ||
        static_cast<std::size_t>(first) + count > g->first + g->count)
      HeaderReader::refuse(ErrorCode::out_of_range, "bodies",
                           fmt::format("'{}' are columns outside of '{}'", what, group));
  };
  for (const HistoryBody& body : h.bodies) {
    if (body.frequencies.size() != body.modes.size())
      HeaderReader::refuse(ErrorCode::wrong_count, "bodies.frequencies_Hz",
                           "not one for each mode");
    if (body.shape >= static_cast<int>(h.shapes.size()))
      HeaderReader::refuse(ErrorCode::not_found, "bodies.shape", "there is no such shape");
    inside("pose", "poses", body.pose, 7);
    inside("amplitudes", "q", body.amplitudes, body.modes.size());
    inside("rates", "v", body.rates, body.modes.size());
  }
}

void check_health(const HistoryHeader& h) {
  const HistoryGroup* g = h.find(health_group);
  if ((g ? g->count : 0) != h.health.size())
    HeaderReader::refuse(
        ErrorCode::wrong_count, "health",
        fmt::format("found {} columns, expected {}", h.health.size(), g ? g->count : 0));
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
  HeaderWriter out;
  out("format", "floatframe states");
  out("units", "SI (m, kg, s, rad)");
  header_fields(out, h);
  return out.json.dump(1, ' ', false, Json::error_handler_t::replace);
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
  header_fields(in, h);
  require_word(h.coordinates, "coordinates", rules::coordinates);
  require_word(h.inertia, "inertia", rules::inertia_methods);
  if (h.owners.size() != h.v.size())
    HeaderReader::refuse(ErrorCode::wrong_count, "v_of", "not one for each velocity");
  check_groups(h);
  check_arrays(h);
  check_bodies(h);
  check_health(h);
  return h;
}

}  // namespace floatframe
