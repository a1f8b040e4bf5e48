#include "floatframe/analyses/body_damping.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "floatframe/body/modal_damping.hpp"
#include "floatframe/core/text_pieces.hpp"
#include "floatframe/formats/body_file/health_text.hpp"
#include "floatframe/linear/linear_system.hpp"

namespace floatframe {
namespace {

/// Number of modes shown per body, and of vibrations of a model.
constexpr std::size_t shown_modes = 5;
/// `check` computes the vibrations of models up to this size: the cost grows with its cube.
constexpr int most_degrees = 150;

struct DampedBodies {
  std::vector<std::string> names;
  OwnDamping own;
};

std::vector<DampedBodies> damped_bodies(const Model& model) {
  std::vector<DampedBodies> out;
  std::map<const FlexibleBody*, std::size_t> place;  // copies of a body share their data
  for (const Body& body : model.bodies) {
    if (body.modes() == 0) continue;
    const auto [it, fresh] = place.emplace(body.data.get(), out.size());
    if (fresh) out.push_back({{}, own_damping(*body.data)});
    out[it->second].names.push_back(body.name);
  }
  std::erase_if(out, [](const DampedBodies& b) { return b.own.free.empty(); });
  return out;
}

nlohmann::ordered_json damped_modes_json(const std::vector<DampedMode>& modes) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const DampedMode& m : modes)
    list.push_back({{"frequency_Hz", m.frequency}, {"fraction", m.fraction}});
  return list;
}

}  // namespace

std::string body_damping_text(const Model& model) {
  std::string text;
  for (const DampedBodies& body : damped_bodies(model)) {
    text += fmt::format("\n  damping of {}, fractions of critical [%] of its own modes\n",
                        names_text(body.names, shown_modes)) +
            own_damping_text(body.own, shown_modes, 2);
  }
  return text;
}

nlohmann::ordered_json body_damping_json(const Model& model) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const DampedBodies& body : damped_bodies(model)) {
    const auto& frame = body.own.frame.empty() ? body.own.free : body.own.frame;
    list.push_back({{"bodies", body.names},
                    {"frame", damped_modes_json(frame)},
                    {"free", damped_modes_json(body.own.free)},
                    {"mounted", damped_modes_json(body.own.mounted)}});
  }
  return list;
}

std::string system_damping_text(const Model& model, int degrees_of_freedom) {
  const bool damped = std::any_of(model.bodies.begin(), model.bodies.end(), [](const Body& body) {
    return body.modes() > 0 && body.data->D.size() > 0 && !body.data->D.isZero(0.0);
  });
  if (!damped) return "";
  const std::string later = "\n  floatframe modes shows what the modes of the model get of it\n";
  if (degrees_of_freedom > most_degrees) return later;
  std::vector<LinearMode> modes;
  try {
    modes = linear_modes(linear_system(model));
  } catch (const std::exception&) {  // `modes` reports the reason
    return later;
  }
  double largest = 0.0;
  for (const LinearMode& m : modes) largest = std::max(largest, std::abs(m.lambda));
  std::string text;
  std::size_t count = 0;
  for (const LinearMode& m : modes) {
    if (!(m.lambda.imag() > 1e-7 * largest) || count == shown_modes) continue;
    text +=
        fmt::format("{}{:.5g} Hz {:.4g} %", count > 0 ? ", " : "", m.damped(), 100.0 * m.damping());
    ++count;
  }
  if (count == 0) return "";
  return fmt::format("\n  damping of the model's first vibrations as it starts: {}\n", text);
}

}  // namespace floatframe
