// Names, units, limits and places of all values in the packets.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "floatframe/apps/realtime_output.hpp"
#include "floatframe/core/text_table.hpp"

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

std::string hash_text(const SignalLayout& layout) {
  return fmt::format("0x{:016x}", layout.hash());
}

std::string limit(double x) { return std::isfinite(x) ? fmt::format("{:g}", x) : ""; }

Json limit_json(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json direction_json(const SignalLayout& layout) {
  return {{"layout", hash_text(layout)}, {"bytes", packet_size(layout.signals.size())}};
}

}  // namespace

std::string layout_text(const Model& model) {
  const SignalLayout in = input_layout(model), out = output_layout(model);
  std::string text = fmt::format("inputs of {}: kind 1, layout {}, {} bytes per packet\n",
                                 model.name, hash_text(in), packet_size(in.signals.size()));
  TextTable inputs({"offset", "name", "unit", "initial", "min", "max"}, {1, 2});
  for (std::size_t i = 0; i < model.inputs.size(); ++i) {
    const Input& x = model.inputs[i];
    inputs.add({std::to_string(packet_size(i)), x.name, x.unit, fmt::format("{:g}", x.initial),
                limit(x.low), limit(x.high)});
  }
  text += inputs.empty() ? "  none\n" : inputs.text(2);
  text += fmt::format("\noutputs of {}: kind 2, layout {}, {} bytes per packet\n", model.name,
                      hash_text(out), packet_size(out.signals.size()));
  TextTable outputs({"offset", "name", "unit"}, {1, 2});
  for (std::size_t i = 0; i < out.signals.size(); ++i)
    outputs.add({std::to_string(packet_size(i)), out.signals[i].name, out.signals[i].unit});
  return text + (outputs.empty() ? "  none\n" : outputs.text(2));
}

std::string layout_json(const Model& model) {
  const SignalLayout in = input_layout(model), out = output_layout(model);
  Json inputs = direction_json(in), outputs = direction_json(out);
  inputs["signals"] = outputs["signals"] = Json::array();
  for (std::size_t i = 0; i < model.inputs.size(); ++i) {
    const Input& x = model.inputs[i];
    inputs["signals"].push_back({{"name", x.name},
                                 {"unit", x.unit},
                                 {"offset", packet_size(i)},
                                 {"initial", x.initial},
                                 {"min", limit_json(x.low)},
                                 {"max", limit_json(x.high)},
                                 {"clamp", x.clamp}});
  }
  for (std::size_t i = 0; i < out.signals.size(); ++i)
    outputs["signals"].push_back(
        {{"name", out.signals[i].name}, {"unit", out.signals[i].unit}, {"offset", packet_size(i)}});
  const Json json = {{"model", model.name}, {"inputs", inputs}, {"outputs", outputs}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
