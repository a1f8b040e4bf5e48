#pragma once
// The file of a checkpoint: the state of a run, what it belongs to, and how far its results were
// written. As bytes: a magic word and the version, the content, a checksum of all before it.
#include <map>
#include <string>
#include <vector>

#include "floatframe/report/results_file.hpp"
#include "floatframe/simulation/simulation.hpp"

namespace floatframe {

/// What a run was begun with; its options are in the state.
struct RunOrigin {
  std::string program;                       ///< which copy of it
  std::map<std::string, std::string> files;  ///< read, from the model file, and their fingerprints
  std::vector<std::string> settings;         ///< "name=value"
};

/// Empty, or in what a checkpoint of one origin is not of a run of the other: "was made ...".
std::string origin_difference(const RunOrigin& found, const RunOrigin& own);

struct CheckpointFile {
  RunOrigin origin;
  double every = 0.0;  ///< [s] of simulated time
  ResultsFile::Position results;
  GrowingFile::Position states;  ///< if they are kept
  RunCheckpoint run;
};

std::string checkpoint_bytes(const CheckpointFile& checkpoint);

/// Throws InputError if there is none, or it is damaged, or of another version.
CheckpointFile read_checkpoint(const std::string& path);

}  // namespace floatframe
