#pragma once
// The files that a command writes beside those that it reads: no output may replace an input or
// another output of the same command.
#include <string>
#include <vector>

namespace floatframe {

/// A file to be written; none if `path` is empty.
struct OutputFile {
  std::string option;  ///< what names it in a sentence: "--report"
  std::string path;
};

/// Files are compared by device and inode where they are there, by folder and name where not.
/// Devices may take several outputs. Throws InputError.
void require_distinct(const std::vector<OutputFile>& outputs,
                      const std::vector<std::string>& inputs);

}  // namespace floatframe
