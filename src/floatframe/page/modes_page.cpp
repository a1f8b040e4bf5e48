#include "floatframe/page/modes_page.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/core/build_info.hpp"
#include "floatframe/page/page_json.hpp"
#include "floatframe/page/scene_json.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

/// The largest shares, each at least a hundredth, at most five.
Json largest_shares(const std::vector<EnergyShare>& shares) {
  constexpr std::size_t most = 5;
  constexpr double least = 0.01;
  Json out = Json::array();
  for (const EnergyShare& s : largest_first(shares))
    if (s.part >= least && out.size() < most) out.push_back({s.name, s.part});
  return out;
}

/// The rows `rows_of` of each motion: real parts, then imaginary ones.
std::vector<float> parts_of(const MatX& rows_of, const std::vector<ShownMotion>& motions) {
  std::vector<float> out;
  for (const ShownMotion& m : motions)
    for (const VecX& part : {VecX(m.mode.z.real()), VecX(m.mode.z.imag())}) {
      const VecX rows = rows_of * part;
      out.insert(out.end(), rows.begin(), rows.end());
    }
  return out;
}

}  // namespace

std::vector<EnergyShare> largest_first(std::vector<EnergyShare> shares) {
  const auto rounded = [](const EnergyShare& s) { return std::round(1e6 * s.part); };
  std::stable_sort(shares.begin(), shares.end(), [&](const EnergyShare& a, const EnergyShare& b) {
    return rounded(a) > rounded(b);
  });
  return shares;
}

Json scene_vibrations(const LinearSystem& system, const std::vector<ShownMotion>& motions,
                      PageBuffer& buffer) {
  Json list = Json::array();
  for (const ShownMotion& m : motions)
    list.push_back({{"number", m.number > 0 ? Json(m.number) : Json()},
                    {"kind", m.kind},
                    {"frequency", m.mode.damped()},
                    {"undamped", m.mode.frequency()},
                    {"damping", m.mode.damping()},
                    {"moves", largest_shares(m.moves)},
                    {"held", largest_shares(m.held)}});
  const auto bodies = static_cast<std::size_t>(system.places_of.rows() / 6);
  const auto amplitudes = static_cast<std::size_t>(system.bends_of.rows());
  const std::size_t count = motions.size();
  Json out{{"list", std::move(list)}, {"places", nullptr}, {"amplitudes", nullptr}};
  const std::vector<float> places = parts_of(system.places_of, motions);
  out["places"] = buffer.add(std::span<const float>(places), {count, 2, bodies, 6});
  if (amplitudes == 0) return out;
  const std::vector<float> bends = parts_of(system.bends_of, motions);
  out["amplitudes"] = buffer.add(std::span<const float>(bends), {count, 2, amplitudes});
  return out;
}

std::string modes_page(const Model& model, const LinearSystem& system,
                       const std::vector<ShownMotion>& motions, const ModesPage& page) {
  PageBuffer buffer;
  Json scene = scene_json(model, scene_frames(model, page.state), buffer);
  scene["vibrations"] = scene_vibrations(system, motions, buffer);
  Json json = empty_page(
      "modes", model.name, build_description(),
      {{"state", "completed"}, {"sentences", page.sentences}, {"warnings", page.warnings}});
  json["facts"] = facts_json(page.facts);
  json["tables"] = tables_json(page.tables);
  json["scene"] = std::move(scene);
  return page_html(page_template(), json, buffer);
}

}  // namespace floatframe
