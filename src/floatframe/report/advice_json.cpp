#include "floatframe/report/advice_json.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

namespace floatframe {
namespace {

using Json = nlohmann::ordered_json;

Json finite_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json cost(const RunSummary& s, double flops) {
  const double steps = static_cast<double>(std::max(1L, s.steps));
  return {{"steps", s.steps},
          {"iterations_per_step", static_cast<double>(s.iterations) / steps},
          {"cpu_us_per_step", 1e6 * s.cpu / steps},
          {"flops_per_step", flops},
          {"warnings", sentences(s.warnings)}};
}

}  // namespace

std::string advice_json(const std::string& model, double step, const ModeAdviceReport& r,
                        const AdviceOptions& options) {
  Json bodies = Json::array();
  for (const BodyAdvice& body : r.bodies) {
    Json modes = Json::array(), free = Json::array();
    for (const ModeAdvice& m : body.modes)
      modes.push_back({{"mode", m.mode + 1},
                       {"name", m.name},
                       {"frequency_Hz", finite_or_null(m.frequency)},
                       {"free_frequency_Hz", finite_or_null(m.free_frequency)},
                       {"omega_h", finite_or_null(m.step_phase)},
                       {"static_share", m.static_share},
                       {"dynamic_share", m.dynamic_share},
                       {"kinetic_ratio", m.kinetic_ratio},
                       {"rms", m.rms},
                       {"peak", m.peak},
                       {"action", word(m.action)},
                       {"retained_by_verification", m.retained}});
    for (const double f : body.free_frequencies) free.push_back(finite_or_null(f));
    bodies.push_back({{"body", body.name}, {"free_frequencies_Hz", free}, {"modes", modes}});
  }
  Json differences = Json::array();
  for (const OutputDifference& d : r.differences)
    differences.push_back({{"output", d.name},
                           {"unit", d.unit},
                           {"range", d.range},
                           {"rms_difference", d.rms},
                           {"largest_difference", d.largest},
                           {"difference_of_peaks", d.peaks},
                           {"solver_noise", d.noise},
                           {"relative", finite_or_null(d.relative)}});
  const Json json = {{"model", model},
                     {"step_s", step},
                     {"modes", r.modes},
                     {"dropped", r.dropped},
                     {"quasi_static", r.quasi_static},
                     {"candidates", r.candidates},
                     {"reduced_models_run", r.trials},
                     {"newton_tolerance_compared", r.tolerance},
                     {"thresholds",
                      {{"drop_share", options.drop_share},
                       {"static_ratio", options.static_ratio},
                       {"tolerance", options.tolerance}}},
                     {"full", cost(r.full, r.flops_full)},
                     {"reduced", cost(r.reduced, r.flops_reduced)},
                     {"refused_by", r.refused_by},
                     {"refused_difference", finite_or_null(r.refused_difference)},
                     {"bodies", bodies},
                     {"differences", differences}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace floatframe
