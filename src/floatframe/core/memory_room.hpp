#pragma once
// Memory for large results is compared with the available memory before it is allocated: the system
// grants more than it has, and kills the process later.
#include <string>

namespace floatframe {

/// Memory that this process may still allocate [bytes]: limited by the machine, its control group
/// and `ulimit -v`. Infinite if unknown.
double memory_room();

/// Empty, or "takes about 46 GB of memory, of which 7.8 GB are free"; for `bytes` of less than 100
/// MB always empty.
std::string memory_complaint(double bytes);

}  // namespace floatframe
