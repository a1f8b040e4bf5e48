#pragma once
// The rotor of Lalanne and Ferraris (support/assembled_rotor.hpp) as model files: a shaft of beams
// from a deck of Nastran or Abaqus, of bars, or of 20-node bricks with discs as point masses.
#include <string>

#include "support/assembled_rotor.hpp"
#include "support/temporary_folder.hpp"

namespace floatframe::test {

enum class RotorKind { cbar, b33, bars, solids };

struct RotorOptions {
  RotorKind kind = RotorKind::cbar;
  bool node_frame = false;           ///< of parts; else mean axis
  bool lumped = false;               ///< cbar: mass_form lumped
  std::string stiffening = "false";  ///< geometric_stiffening; empty: no key
  std::string coordinates = "relative", inertia = "preprocessing";
  std::string extra;  ///< further sections of the model file
  double step = 1e-5, duration = 0.1;
  double speed = 0.0;   ///< at the start of a run [rad/s]
  double across = 0.0;  ///< velocity along y there [m/s]
  int modes = 25;       ///< of parts
};

/// Writes what the model needs into `folder` and returns the path of the model file.
std::string write_rotor(const TemporaryFolder& folder, const AssembledRotor& rotor,
                        const RotorOptions& options);

}  // namespace floatframe::test
