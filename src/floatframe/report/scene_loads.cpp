#include "floatframe/report/scene_loads.hpp"

#include "floatframe/history/recorded_motion.hpp"
#include "floatframe/model/gauge.hpp"
#include "floatframe/simulation/run_error.hpp"

namespace floatframe {

void add_load_coefficients(const Model& model, const StateHistory& history,
                           const SimulationDescription& options, SceneFrames& frames) {
  std::vector<int> first;
  int columns = 0;
  for (std::size_t b = 0; b < model.bodies.size(); ++b) {
    const auto& stress = model.bodies[b].data->stress;
    const bool has =
        stress && stress->loads.size() > 0 && b < frames.known.size() && frames.known[b] != 0;
    first.push_back(has ? columns : -1);
    if (has) columns += body_load_cases;
  }
  if (columns == 0 || frames.instants.size() < 2) return;
  try {
    RecordedMotion motion(history, model, options);
    std::vector<double> loads;
    for (const std::size_t k : frames.instants) {
      const OutputView& view = motion.at(k);
      for (std::size_t b = 0; b < first.size(); ++b) {
        if (first[b] < 0) continue;
        const BodyLoadCoefficients c = body_load_coefficients(view, static_cast<int>(b));
        loads.insert(loads.end(), c.begin(), c.end());
      }
    }
    frames.loads = std::move(loads);
    frames.first_load = std::move(first);
  } catch (const RunError&) {
    // The page shows the stress of the amplitudes alone.
  }
}

}  // namespace floatframe
