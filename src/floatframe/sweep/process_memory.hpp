#pragma once
// Memory use of a process, as reported by the system; in MB of 1e6 bytes.

namespace floatframe {

/// Resident and swapped memory; 0 if the system does not report it.
double memory_of(int process);

/// Largest resident memory of this process since `forget_peak_memory`, or since its start; 0 if the
/// system does not report it.
double peak_memory();

/// False if the system does not support it.
bool forget_peak_memory();

}  // namespace floatframe
