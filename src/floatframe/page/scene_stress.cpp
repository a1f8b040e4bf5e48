#include "floatframe/page/scene_stress.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/body/stress_peaks.hpp"
#include "floatframe/body/surface_mesh.hpp"
#include "floatframe/model/gauge.hpp"

namespace floatframe {
namespace {

/// Candidate stress places of each vertex.
std::vector<std::vector<int>> places_at(const BodyStress& stress, const SurfaceMesh& mesh) {
  std::vector<std::vector<int>> out(static_cast<std::size_t>(mesh.positions.cols()));
  if (mesh.bar_ends.empty()) {
    for (std::size_t k = 0; k < stress.places.size(); ++k) {
      const int point = stress.places[k].point;
      if (point >= 0 && point < static_cast<int>(out.size()))
        out[point].push_back(static_cast<int>(k));
    }
    return out;
  }
  // For a swept section, the nearest outer point of that end.
  for (std::size_t v = 0; v < mesh.bar_ends.size(); ++v) {
    const std::size_t section = 2 * static_cast<std::size_t>(mesh.bar_ends[v].bar) +
                                static_cast<std::size_t>(mesh.bar_ends[v].end);
    if (section + 1 >= stress.first_place.size()) continue;
    const int nearest =
        nearest_place(stress, stress.first_place[section], stress.first_place[section + 1],
                      mesh.positions.col(static_cast<Eigen::Index>(v)));
    if (nearest >= 0) out[v].push_back(nearest);
  }
  return out;
}

/// Sum of the von Mises stresses of the modes, each of unit strain energy.
double load_of(const BodyStress& stress, const VecX& unit, int place) {
  double sum = 0.0;
  for (Eigen::Index m = 0; m < stress.modes.cols(); ++m)
    sum += unit[m] * von_mises(stress.modes.block<6, 1>(6 * static_cast<Eigen::Index>(place), m));
  return sum;
}

/// True if a vertex changes by more than a hundredth of the largest stress.
bool loads_matter(const std::vector<float>& without, const std::vector<float>& with) {
  float most = 0.0F, apart = 0.0F;
  for (std::size_t v = 0; v < with.size(); ++v) {
    most = std::max(most, with[v]);
    apart = std::max(apart, std::abs(with[v] - without[v]));
  }
  return apart > 0.01F * most;
}

/// The components of each place by column, in units of `factor`; 0 if there is no place.
std::vector<float> scaled(const MatX& columns, const std::vector<int>& places, double& factor) {
  // Half floats range from 6e-5 to 6e4: the largest value stays well below.
  const double largest = columns.cwiseAbs().maxCoeff();
  factor = largest > 0.0 ? largest / 1e4 : 1.0;
  std::vector<float> out;
  out.reserve(6 * places.size() * static_cast<std::size_t>(columns.cols()));
  for (const int place : places)
    for (Eigen::Index k = 0; k < columns.cols(); ++k)
      for (Eigen::Index c = 0; c < 6; ++c)
        out.push_back(place < 0
                          ? 0.0F
                          : static_cast<float>(
                                columns(6 * static_cast<Eigen::Index>(place) + c, k) / factor));
  return out;
}

}  // namespace

int nearest_place(const BodyStress& stress, int first, int end, const Vec3& p) {
  double least = std::numeric_limits<double>::infinity();
  int nearest = -1;
  for (int k = first; k < end; ++k) {
    const double away = (stress.places[k].p - p).squaredNorm();
    if (away < least) nearest = k;
    least = std::min(least, away);
  }
  return nearest;
}

SceneStress scene_stress(const FlexibleBody& body) {
  SceneStress out;
  if (!body.stress || body.modes() == 0 || body.stress->places.empty()) return out;
  const BodyStress& stress = *body.stress;
  const SurfaceMesh mesh = surface_mesh(body);
  const auto vertices = static_cast<std::size_t>(mesh.positions.cols());
  const auto nm = static_cast<std::size_t>(body.modes());
  if (6 * vertices * nm > most_numbers_of_stress) out.left_out = 6 * vertices * nm;
  if (vertices == 0 || out.left_out > 0) return out;
  const VecX unit =
      body.K.diagonal().unaryExpr([](double k) { return k > 0.0 ? 1.0 / std::sqrt(k) : 0.0; });
  std::size_t known = 0;
  out.all_places = places_at(stress, mesh);
  for (const std::vector<int>& here : out.all_places) {
    if (here.size() > 1) out.several = true;
    int shown = -1;
    double most = -1.0;
    for (const int place : here) {
      const double load = here.size() > 1 ? load_of(stress, unit, place) : 0.0;
      if (load > most) shown = place;
      most = std::max(most, load);
    }
    if (shown >= 0) ++known;
    if (shown < 0 || stress.places[shown].doubtful)
      out.doubtful.push_back(static_cast<std::uint32_t>(out.places.size()));
    out.places.push_back(shown);
  }
  if (known == 0) return {};
  out.modes = scaled(stress.modes, out.places, out.factor);
  return out;
}

SceneLoads scene_loads(const FlexibleBody& body, const SceneStress& stress) {
  SceneLoads out;
  out.loads = scaled(body.stress->loads.leftCols<body_load_cases>(), stress.places, out.factor);
  return out;
}

VertexEnvelopes vertex_envelopes(const FlexibleBody& body, const SceneStress& stress,
                                 const SceneFrames& frames, std::size_t first, std::size_t columns,
                                 int first_load) {
  std::vector<int> slot(body.stress->places.size(), -1), places;  // each place once
  for (const std::vector<int>& here : stress.all_places)
    for (const int place : here) {
      if (slot[place] >= 0) continue;
      slot[place] = static_cast<int>(places.size());
      places.push_back(place);
    }
  StressPeaks peaks(*body.stress, places, first_load >= 0);
  const auto numbers = [&frames](const std::vector<double>& from, std::size_t all,
                                 std::size_t column, int count) {
    const auto instants = std::ssize(frames.time);
    const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>
        table(from.data(), instants, static_cast<Eigen::Index>(all));
    return MatX(table.middleCols(static_cast<Eigen::Index>(column), count));
  };
  peaks.add(numbers(frames.amplitudes, columns, first, body.modes()),
            first_load < 0 ? MatX()
                           : numbers(frames.loads, frames.load_columns(),
                                     static_cast<std::size_t>(first_load), body_load_cases));
  const auto envelope = [&](const std::vector<StressPeaks::Peak>& of) {
    VertexEnvelope out;
    for (const std::vector<int>& here : stress.all_places) {
      StressPeaks::Peak most;
      for (const int place : here)
        if (of[slot[place]].square > most.square) most = of[slot[place]];
      out.largest.push_back(static_cast<float>(std::sqrt(most.square)));
      out.when.push_back(most.instant < 0 ? 0.0F : static_cast<float>(frames.time[most.instant]));
    }
    return out;
  };
  VertexEnvelopes out{envelope(peaks.of_modes()), {}};
  if (first_load >= 0) out.with_loads = envelope(peaks.of_all());
  return out;
}

SceneStressWriter::Shape SceneStressWriter::shape(const FlexibleBody& data) {
  Shape out;
  out.stress = scene_stress(data);
  if (out.stress.empty()) return out;
  out.json = {
      {"factor", out.stress.factor},
      {"several", out.stress.several},
      {"modes", buffer_.add_half(out.stress.modes, {out.stress.places.size(),
                                                    static_cast<std::size_t>(data.modes()), 6})},
      {"doubtful", buffer_.add(std::span<const std::uint32_t>(out.stress.doubtful),
                               {out.stress.doubtful.size()})}};
  return out;
}

SceneStressWriter::Json SceneStressWriter::of(const FlexibleBody& data, Shape& shape,
                                              std::size_t first, std::size_t body) {
  Json out = shape.json;
  if (out.is_null() || frames_.time.size() < 2 || !data.stress) return out;
  std::size_t columns = 0;
  for (const Body& b : model_.bodies) columns += static_cast<std::size_t>(b.modes());
  const int first_load = frames_.first_load.empty() ? -1 : frames_.first_load[body];
  VertexEnvelopes envelopes =
      vertex_envelopes(data, shape.stress, frames_, first, columns, first_load);
  VertexEnvelope& envelope = envelopes.by_modes;
  if (first_load >= 0 && loads_matter(envelope.largest, envelopes.with_loads.largest)) {
    envelope = std::move(envelopes.with_loads);
    add_loads(data, shape);
    out["loads"] = shape.loads;
    out["first_load"] = columns + columns_.size();
    for (int k = 0; k < body_load_cases; ++k)
      columns_.push_back(
          {static_cast<std::size_t>(first_load + k), shape.loads_factor / shape.stress.factor});
  }
  out["envelope"] =
      buffer_.add(std::span<const float>(envelope.largest), {envelope.largest.size()});
  out["all_instants"] = frames_.whole;
  out["when"] = buffer_.add(std::span<const float>(envelope.when), {envelope.when.size()});
  return out;
}

void SceneStressWriter::append_loads(std::size_t frame, std::vector<float>& row) const {
  for (const LoadColumn& c : columns_)
    row.push_back(
        static_cast<float>(c.scale * frames_.loads[frame * frames_.load_columns() + c.column]));
}

void SceneStressWriter::add_loads(const FlexibleBody& data, Shape& shape) {
  if (!shape.loads.is_null()) return;
  const SceneLoads loads = scene_loads(data, shape.stress);
  shape.loads_factor = loads.factor;
  shape.loads = buffer_.add_half(
      loads.loads, {shape.stress.places.size(), static_cast<std::size_t>(body_load_cases), 6});
}

}  // namespace floatframe
