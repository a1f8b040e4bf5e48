#pragma once
// A large stack for the program where the system's is small (`ulimit -s 256`, some batch systems):
// products of sparse matrices and the prefaulted stack of real-time runs take up to a megabyte, and
// a stack overflow is a crash without a message.
#include <functional>

namespace floatframe {

/// Calls `act` on a stack of at least 8 MB, and gives later threads of the process the same size.
/// Uses the present stack if it may grow that far, or if there is no memory for another. `act` must
/// not throw.
int on_ample_stack(const std::function<int()>& act);

}  // namespace floatframe
