#pragma once
// The program's own stack where the system's is small (`ulimit -s 256`, some batch systems):
// products of sparse matrices and the prefaulted stack of real time take up to a megabyte of it,
// and running out of it is a crash without a word.
#include <functional>

namespace floatframe {

/// Calls `act` on a stack of at least 8 MB, and gives later threads of the process as much: on the
/// present stack if that is allowed to grow so far, or if there is no memory for another.
/// `act` must not throw.
int on_ample_stack(const std::function<int()>& act);

}  // namespace floatframe
