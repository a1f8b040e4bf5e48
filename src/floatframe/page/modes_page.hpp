#pragma once
// The page of the natural vibrations of a model, for the viewer (viewer/README.md): the state and,
// for each motion e^(lambda t), the complex shape s, so that the page can draw
//   x(t) = Re(s e^(i phi)) = Re s cos phi - Im s sin phi
// with Im lambda >= 0: travelling or whirling shapes move in the right direction. For each body, s
// is the displacement of its origin [m] and its rotation vector [rad] in world axes, then its modal
// amplitudes.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "floatframe/description/system_state.hpp"
#include "floatframe/linear/linear_system.hpp"
#include "floatframe/page/page_writer.hpp"
#include "floatframe/page/run_report.hpp"

namespace floatframe {

/// Share of an energy in a body or a force element.
struct EnergyShare {
  std::string name;
  double part;
};

/// Equal ones, as those of symmetric bodies are to 1e-6, in the order of the model.
std::vector<EnergyShare> largest_first(std::vector<EnergyShare> shares);

/// A motion in the table and in the scene.
struct ShownMotion {
  LinearMode mode;
  std::string kind;                ///< "vibration", "rigid", "held", "decay", "growth", "unstable"
  int number = 0;                  ///< in the table; 0: its root is zero
  std::vector<EnergyShare> moves;  ///< shares of the kinetic energy, by body
  std::vector<EnergyShare> held;   ///< of the potential energy, by flexible body and force
};

struct ModesPage {
  SystemState state;
  std::vector<std::string> sentences, warnings;
  std::vector<FactTable> facts;
  std::vector<PageTable> tables;
};

/// The motions as part of the scene.
nlohmann::ordered_json scene_vibrations(const LinearSystem& system,
                                        const std::vector<ShownMotion>& motions,
                                        PageBuffer& buffer);

/// Requires a program built with the viewer.
std::string modes_page(const Model& model, const LinearSystem& system,
                       const std::vector<ShownMotion>& motions, const ModesPage& page);

}  // namespace floatframe
