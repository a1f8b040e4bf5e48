#pragma once

namespace floatframe {

/// Of one request; 0: none.
struct WorkerLimits {
  double seconds = 0.0;  ///< wall time
  /// Of the worker, resident and swapped; 1 MB = 1e6 bytes. Looked at 50 times a second and, its
  /// peak, at the end of a request. It is no limit of the system: many libraries never return, or
  /// crash, when the system refuses them memory.
  double megabytes = 0.0;
};

}  // namespace floatframe
