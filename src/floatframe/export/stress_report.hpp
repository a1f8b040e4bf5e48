#pragma once
// Envelopes of stress as tables for the terminal, as JSON, as CSV and as arrays of NumPy
// (docs/stress.md).
#include <string>

#include "floatframe/export/export_file.hpp"
#include "floatframe/export/hot_spots.hpp"

namespace floatframe {

struct StressedBody {
  int body = -1;  ///< of the model
  StressEnvelope envelope;
  std::vector<HotSpot> hot_spots;
  std::vector<SectionPeak> peaks;
};

struct StressReport {
  const Model* model = nullptr;
  std::size_t instants = 0;
  double from = 0.0, to = 0.0;  ///< first and last instant [s]
  std::vector<StressedBody> bodies;
  std::vector<std::string> without;  ///< flexible bodies without stress data
};

std::string stress_text(const StressReport& report);
std::string stress_json(const StressReport& report);
std::string hot_spots_csv(const StressReport& report);
/// Smallest and largest value of every section force.
std::string section_forces_csv(const StressReport& report);
/// The bytes of a .npz file. Throws InputError if they exceed its format.
std::string envelope_npz(const StressReport& report);

}  // namespace floatframe
