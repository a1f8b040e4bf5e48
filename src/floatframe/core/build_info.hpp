#pragma once
// Version, build and machine of the running library: for `--version`, reports and benchmarks.
#include <string>

namespace floatframe {

/// "0.1.0"
std::string version();

/// "0.1.0, Release, GNU 12.2.0, x86-64-v3": version, build type, compiler, instruction set,
/// sanitizers if any.
std::string build_description();

/// Instruction set the loaded copy of the library was compiled for: "x86-64", "x86-64-v3" or
/// "generic". The dynamic linker loads the x86-64-v3 copy (AVX2, FMA) where the processor has it.
std::string instruction_set();

/// Model name of the processor as reported by the system, "unknown processor" if unavailable.
std::string processor_name();

}  // namespace floatframe
