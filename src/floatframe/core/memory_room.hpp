#pragma once
// What large results take is compared with what there is before it is asked for: the system gives
// more than it has, and ends the process later.
#include <string>

namespace floatframe {

/// Memory that this process may still get [bytes]: of the machine, of its control group, and up to
/// `ulimit -v`. Infinite where nothing tells.
double memory_room();

/// Empty, or "takes about 46 GB of memory, of which 7.8 GB are free"; for `bytes` of less than 100
/// MB always empty.
std::string memory_complaint(double bytes);

}  // namespace floatframe
