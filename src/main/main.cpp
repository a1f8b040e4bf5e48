// The program `floatframe`: the command line with its benchmarks, and the library, of which the
// dynamic linker picks the copy that fits the processor.
#include "floatframe/apps/command_line.hpp"
#include "floatframe/bench/bench_command.hpp"

int main(int argc, char** argv) {
  return floatframe::command_line_main(argc, argv, {floatframe::bench_command()});
}
