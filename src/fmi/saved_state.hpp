#pragma once
// What an importer keeps of an instance: the state machine, the run, and the bytes of the
// simulation. In a file or in another process as bytes of one form (little-endian, as all platforms
// that Floatframe is built for), with the fingerprint of the model and a checksum.
#include <cstddef>
#include <limits>
#include <vector>

#include "fmi/state_machine.hpp"

namespace floatframe::fmi {

/// Figures of a run, which are variables of the FMU in this order: inner steps, their substeps
/// and Newton iterations; steps of the importer that took longer than they last, and the largest
/// part of a step that it took.
enum class Figure { steps, substeps, iterations, overruns, largest_share };
inline constexpr int figure_count = 5;

/// What belongs to one run and is forgotten by a reset.
struct Run {
  double start = 0.0;                                     ///< [s]
  double stop = std::numeric_limits<double>::infinity();  ///< [s]
  double shift = 0.0;       ///< time of the FMU minus that of the model [s]
  bool needs_start = true;  ///< inputs or parameters are newer than the start
  double overruns = 0.0, largest_share = 0.0;
};

struct SavedState {
  State state = State::instantiated;
  Run run;
  std::vector<double> inputs, parameters;  ///< if a start is needed; else they are in `model`
  std::vector<unsigned char> model;        ///< of floatframe_save
};

/// Who may read the bytes.
struct StateOwner {
  int version = 2;               ///< of FMI
  const char* fingerprint = "";  ///< of the model
  std::size_t inputs = 0, parameters = 0;
};

std::size_t bytes_of(const SavedState& state);
/// `bytes` has room for `bytes_of(state)`.
void write_bytes(const SavedState& state, const StateOwner& owner, unsigned char* bytes);
/// NULL if all is well, else what is wrong.
const char* read_bytes(const unsigned char* bytes, std::size_t size, const StateOwner& owner,
                       SavedState& state);

}  // namespace floatframe::fmi
