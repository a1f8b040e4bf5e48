#pragma once
// What this library is and where it runs: for `floatframe --version`, reports and benchmark tables.
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

/// Model name of the processor as the system tells it, "unknown processor" if it does not.
std::string processor_name();

}  // namespace floatframe
