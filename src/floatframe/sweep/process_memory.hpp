#pragma once
// How much memory a process uses, as the system reports it; in MB of 1e6 bytes.

namespace floatframe {

/// Resident and swapped; 0 if the system does not say.
double memory_of(int process);

/// Largest resident memory of this process since `forget_peak_memory`, or since its start; 0 if the
/// system does not say.
double peak_memory();

/// False if the system cannot.
bool forget_peak_memory();

}  // namespace floatframe
