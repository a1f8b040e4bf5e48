#pragma once

namespace floatframe {

/// Limits of one request; 0: none.
struct WorkerLimits {
  double seconds = 0.0;  ///< wall time
  /// Of the worker, resident and swapped; 1 MB = 1e6 bytes. Polled 50 times a second, and the peak
  /// at the end of a request. It is not a limit of the system: many libraries hang or crash when
  /// the system refuses memory.
  double megabytes = 0.0;
};

}  // namespace floatframe
