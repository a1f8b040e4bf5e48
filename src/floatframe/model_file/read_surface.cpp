// Roads with width: heights by formula, grid, OpenCRG file or two random tracks, and friction.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "floatframe/core/text_pieces.hpp"
#include "floatframe/description/random_tracks.hpp"
#include "floatframe/description/rules.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/parts/part_job.hpp"
#include "floatframe/roads/crg_file.hpp"
#include "floatframe/yaml/csv_file.hpp"

namespace floatframe {
namespace {

constexpr std::size_t most_places = 10000;  // of a grid along x or y
constexpr std::size_t most_patches = 1000;

struct GridNumbers {
  std::vector<double> x, y;
  MatX z;
};

/// x, y and z, a row of heights for each x.
std::optional<GridNumbers> read_grid_lists(YamlSection& s) {
  GridNumbers grid;
  const auto places = [&](const char* key) {
    const auto v = s.require(key);
    return v ? v->numbers(2, most_places, any_number("m"), "at least 2 numbers") : std::nullopt;
  };
  const auto x = places("x"), y = places("y");
  const auto z = s.require("z");
  if (!x || !y || !z) return std::nullopt;
  const std::vector<YamlValue> rows = z->list("rows of heights");
  if (rows.size() != x->size()) {
    z->error(ErrorCode::wrong_count,
             fmt::format("found {} rows, expected {}, one for each x", rows.size(), x->size()));
    return std::nullopt;
  }
  grid.x = *x;
  grid.y = *y;
  grid.z.resize(std::ssize(*x), std::ssize(*y));
  const std::string what = fmt::format("{} heights, one for each y", y->size());
  Eigen::Index i = 0;
  for (const YamlValue& item : rows) {
    const auto row = item.numbers(y->size(), y->size(), any_number("m"), what.c_str());
    if (!row) return std::nullopt;
    grid.z.row(i++) = VecX::Map(row->data(), std::ssize(*row)).transpose();
  }
  return grid;
}

/// A CSV file: y in the first line after a cell that is not read, then rows of x and heights.
std::optional<GridNumbers> read_grid_file(const ModelInstance& self, const YamlValue& value) {
  const auto name = value.text("the name of a CSV file");
  if (!name) return std::nullopt;
  const std::string file = sibling_path(self, *name);
  std::string text;
  if (!read_text_file(file, text, *self.context.errors, value.mark(), value.path()))
    return std::nullopt;
  const CsvFile csv = parse_csv(std::move(text), DecimalSign::automatic);
  const auto fail = [&](int line, const std::string& sentence) {
    self.context.errors->add(
        {{file, line, 1}, ErrorCode::wrong_value, value.path() + ": " + sentence, 1, value.path()});
    return std::nullopt;
  };
  const bool named = !csv.names.empty();
  const std::size_t first = named ? 0 : 1;
  if (csv.uneven != 0)
    return fail(csv.uneven_line, fmt::format("found {} columns, expected {} as in the first row",
                                             csv.uneven, csv.columns));
  if (csv.columns < 3 || csv.rows() < first + 2)
    return fail(1, fmt::format("found {} rows and {} columns of heights, expected at least 2 each",
                               csv.rows() > first ? csv.rows() - first : 0,
                               csv.columns > 0 ? csv.columns - 1 : 0));
  GridNumbers grid;
  for (std::size_t j = 1; j < csv.columns; ++j) {
    const auto y = named ? finite_number(csv.names[j]) : std::optional(csv.at(0, j));
    if (!y || !std::isfinite(*y))
      return fail(named ? 1 : csv.lines[0],
                  fmt::format("found no number in column {}, expected y [m]", j + 1));
    grid.y.push_back(*y);
  }
  grid.z.resize(csv.rows() - first, std::ssize(grid.y));
  for (std::size_t i = first; i < csv.rows(); ++i)
    for (std::size_t j = 0; j < csv.columns; ++j) {
      const double number = csv.at(i, j);
      if (!std::isfinite(number))
        return fail(csv.lines[i], fmt::format("found '{}' in column {}, expected a number [m]",
                                              csv.cell(i, j), j + 1));
      if (j == 0)
        grid.x.push_back(number);
      else
        grid.z(i - first, j - 1) = number;
    }
  return grid;
}

std::shared_ptr<const HeightGrid> read_height_grid(const ModelInstance& self,
                                                   const YamlValue& value) {
  auto s = value.section("a map with x, y and z, or with file");
  if (!s) return nullptr;
  GridInterpolation interpolation{};
  GridOutside outside{};
  s->word("interpolation", grid_interpolation_words, interpolation);
  s->word("outside", grid_outside_words, outside);
  const auto file = s->get("file");
  const auto numbers = file ? read_grid_file(self, *file) : read_grid_lists(*s);
  s->finish();
  if (!numbers) return nullptr;
  try {
    return std::make_shared<const HeightGrid>(
        height_grid(numbers->x, numbers->y, numbers->z, interpolation, outside));
  } catch (const InputError& e) {
    value.error(e.errors().front().code, e.errors().front().message);
    return nullptr;
  }
}

/// The name of a file, or {file, interpolation, border_u, border_v, begin}.
std::shared_ptr<const CrgRoad> read_crg_road(const ModelInstance& self, const YamlValue& value) {
  auto s = value.is_scalar() ? std::nullopt : value.section("the name of a file, or a map");
  if (!s && !value.is_scalar()) return nullptr;
  const auto named = s ? s->require("file") : std::optional(value);
  CrgInterpolation interpolation{};
  std::optional<std::size_t> border_u, border_v;
  std::size_t begin = 0;
  if (s) {
    s->word("interpolation", crg_interpolation_words, interpolation);
    if (const auto v = s->get("border_u")) border_u = v->word(crg_border_words);
    if (const auto v = s->get("border_v")) border_v = v->word(crg_border_words);
    if (const auto v = s->get("begin")) begin = v->word({"file", "origin"}).value_or(0);
    s->finish();
  }
  const auto name = named ? named->text("the name of an OpenCRG file") : std::nullopt;
  if (!name) return nullptr;
  const std::string file = sibling_path(self, *name);
  try {
    note_file_read(file, file_hash(file));
    auto road = std::make_shared<CrgRoad>(read_crg(std::filesystem::path(file)));
    road->interpolation = interpolation;
    if (border_u) road->edge_u.mode = static_cast<CrgBorder>(*border_u);
    if (border_v) road->edge_v.mode = static_cast<CrgBorder>(*border_v);
    if (begin == 1) begin_at_origin(*road);
    return road;
  } catch (const InputError& e) {
    const ErrorEntry& error = e.errors().front();
    if (error.code == ErrorCode::unreadable)
      named->error(error.code, "'" + file + "': " + error.message);
    else
      self.context.errors->add(
          {error.mark, error.code, value.path() + ": " + error.message, 1, value.path()});
    return nullptr;
  }
}

std::shared_ptr<const TwoTracks> read_tracks(const YamlValue& value) {
  auto s = value.section("a map with class (or roughness), length, width and seed");
  if (!s) return nullptr;
  const std::size_t before = value.context().errors->size();
  TrackSpectrum tracks;
  tracks.road = read_spectrum_keys(*s);
  tracks.width = s->required_number("width", rules::track_width, 1.5);
  tracks.centre = s->number("centre", any_number("m"), 0.0);
  s->word("coherence", track_coherence_words, tracks.coherence);
  const auto decay = s->get("decay");
  if (tracks.coherence == TrackCoherence::exponential)
    tracks.decay = s->required_number("decay", rules::track_decay, 1.0);
  else if (decay)
    decay->error(ErrorCode::incomplete, "needs 'coherence: exponential'");
  s->finish();
  if (value.context().errors->size() != before) return nullptr;
  return std::make_shared<const TwoTracks>(random_tracks(tracks));
}

std::vector<FrictionPatch> read_patches(const YamlValue& value) {
  std::vector<FrictionPatch> out;
  const std::vector<YamlValue> items = value.list("a list of patches {x, y, friction}");
  if (items.size() > most_patches) {
    value.error(ErrorCode::too_large,
                fmt::format("found {} patches, expected at most {}", items.size(), most_patches));
    return out;
  }
  for (const YamlValue& item : items) {
    auto s = item.section("a patch {x, y, friction}");
    if (!s) continue;
    FrictionPatch patch;
    const auto range = [&](const char* key, double& low, double& high) {
      const auto v = s->require(key);
      const auto x = v ? v->numbers(2, 2, any_number("m"), "two numbers [from, to]") : std::nullopt;
      if (x) low = (*x)[0], high = (*x)[1];
      return x.has_value();
    };
    const bool along = range("x", patch.x0, patch.x1), across = range("y", patch.y0, patch.y1);
    patch.friction = s->required_number("friction", rules::road_friction, 1.0);
    s->finish();
    if (along && across) out.push_back(patch);
  }
  return out;
}

}  // namespace

std::shared_ptr<const RoadSurface> read_surface(const ModelInstance& self, YamlSection& road) {
  RoadSurface surface;
  bool any = false;
  const auto get = [&](const char* key) {
    auto value = road.get(key);
    any = any || value;
    return value;
  };
  if (const auto v = get("height")) surface.height = read_height(self, *v);
  if (const auto v = get("grid")) surface.grid = read_height_grid(self, *v);
  if (const auto v = get("crg")) surface.crg = read_crg_road(self, *v);
  if (const auto v = get("tracks")) surface.tracks = read_tracks(*v);
  if (const auto v = get("friction"))
    surface.friction = v->number(rules::road_friction).value_or(1.0);
  if (const auto v = get("patches")) surface.patches = read_patches(*v);
  return any ? std::make_shared<const RoadSurface>(std::move(surface)) : nullptr;
}

}  // namespace floatframe
