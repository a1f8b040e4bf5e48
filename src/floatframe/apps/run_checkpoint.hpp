#pragma once
// Checkpoint file: the state of a run, its origin, and the positions reached in its result files.
// Format: a magic word and the version, the content, a checksum of all before it.
#include <map>
#include <string>
#include <vector>

#include "floatframe/results/results_file.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {

/// The inputs of a run; its options are part of the state.
struct RunOrigin {
  std::string program;                       ///< build of the program
  std::map<std::string, std::string> files;  ///< files read, and their fingerprints
  std::vector<std::string> settings;         ///< "name=value"
};

/// Empty if both origins are of the same run; else the difference: "was made ...".
std::string origin_difference(const RunOrigin& found, const RunOrigin& own);

struct CheckpointFile {
  RunOrigin origin;
  double every = 0.0;  ///< [s] of simulated time
  ResultsFile::Position results;
  GrowingFile::Position states;  ///< if recorded
  RunCheckpoint run;
};

std::string checkpoint_bytes(const CheckpointFile& checkpoint);

/// Throws InputError if it is missing, damaged or of another version.
CheckpointFile read_checkpoint(const std::string& path);

}  // namespace floatframe
