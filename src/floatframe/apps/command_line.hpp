#pragma once
// The program `floatframe`: `run`, `check`, `statics` and `bench`. Results go to files and standard
// output, errors to standard error, one per line.

namespace floatframe {

/// Exit code 0: done; 1: the run, or the program itself, failed; 2: bad input (model file, options,
/// output folder).
int command_line_main(int argc, char** argv);

}  // namespace floatframe
