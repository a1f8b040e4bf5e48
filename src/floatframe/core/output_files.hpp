#pragma once
// The output and input files of a command: no output may replace an input or another output of the
// same command.
#include <string>
#include <vector>

namespace floatframe {

/// A file to be written; none if `path` is empty.
struct OutputFile {
  std::string option;  ///< its name in messages: "--report"
  std::string path;
};

/// Existing files are compared by device and inode, others by folder and name. Devices may take
/// several outputs. Throws InputError.
void require_distinct(const std::vector<OutputFile>& outputs,
                      const std::vector<std::string>& inputs);

}  // namespace floatframe
