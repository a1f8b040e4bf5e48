#pragma once
// The page of the natural vibrations of a model, for the viewer (viewer/README.md): the state they
// are of, and of each motion e^(lambda t) the complex shape s, so that the page can draw
//   x(t) = Re(s e^(i phi)) = Re s cos phi - Im s sin phi
// with Im lambda >= 0: shapes that travel or whirl go the way the model does. s is, of each body,
// the displacement of its origin [m] and its rotation vector [rad] in axes of the world, then its
// modal amplitudes.
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "floatframe/model/system_state.hpp"
#include "floatframe/report/page_writer.hpp"
#include "floatframe/report/run_report.hpp"
#include "floatframe/simulation/linear_system.hpp"

namespace floatframe {

/// Part of an energy, of a body or a force element.
struct EnergyShare {
  std::string name;
  double part;
};

/// A motion as it is listed and drawn.
struct ShownMotion {
  LinearMode mode;
  std::string kind;                ///< "vibration", "rigid", "decay", "growth", "unstable"
  int number = 0;                  ///< in the table; 0: a rigid motion
  std::vector<EnergyShare> moves;  ///< of the kinetic energy, by body
  std::vector<EnergyShare> held;   ///< of the potential energy, by flexible body and force
};

struct ModesPage {
  SystemState state;
  std::vector<std::string> sentences, warnings;
  std::vector<FactTable> facts;
  std::vector<PageTable> tables;
};

/// What the scene holds of the motions.
nlohmann::ordered_json scene_vibrations(const LinearSystem& system,
                                        const std::vector<ShownMotion>& motions,
                                        PageBuffer& buffer);

/// Needs a program that was built with the viewer.
std::string modes_page(const Model& model, const LinearSystem& system,
                       const std::vector<ShownMotion>& motions, const ModesPage& page);

}  // namespace floatframe
