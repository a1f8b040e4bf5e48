#include "floatframe/report/scene_stress_json.hpp"

#include <algorithm>
#include <cmath>

namespace floatframe {
namespace {

/// More than a hundredth of the largest stress at some vertex.
bool loads_matter(const std::vector<float>& without, const std::vector<float>& with) {
  float most = 0.0F, apart = 0.0F;
  for (std::size_t v = 0; v < with.size(); ++v) {
    most = std::max(most, with[v]);
    apart = std::max(apart, std::abs(with[v] - without[v]));
  }
  return apart > 0.01F * most;
}

}  // namespace

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
  VertexEnvelope envelope = vertex_envelope(data, shape.stress, frames_, first, columns, -1);
  const int first_load = frames_.first_load.empty() ? -1 : frames_.first_load[body];
  if (first_load >= 0) {
    VertexEnvelope all = vertex_envelope(data, shape.stress, frames_, first, columns, first_load);
    if (loads_matter(envelope.largest, all.largest)) {
      envelope = std::move(all);
      add_loads(data, shape);
      out["loads"] = shape.loads;
      out["first_load"] = columns + columns_.size();
      for (int k = 0; k < body_load_cases; ++k)
        columns_.push_back(
            {static_cast<std::size_t>(first_load + k), shape.loads_factor / shape.stress.factor});
    }
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
