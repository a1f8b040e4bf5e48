#pragma once
// Inputs and outputs of every step, written to a file while the model runs: comma-separated values
// with one header line, `time [s],input.push [N],...,x [m],...`, 17 digits. The stepping thread
// only puts a row into a ring; another thread writes it to the system every 50 ms, so that the file
// can be followed, and all but the last rows survive if the program is killed.
#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "floatframe/model/model.hpp"

namespace floatframe {

class SignalLog {
 public:
  /// Opens the file and writes its header. `wait`: a full ring makes `push` wait (unpaced runs),
  /// otherwise the row is lost and counted. Throws OutputError.
  SignalLog(const Model& model, const std::string& path, bool wait);
  /// Writes the remaining rows.
  ~SignalLog();
  SignalLog(const SignalLog&) = delete;
  SignalLog& operator=(const SignalLog&) = delete;

  /// The outputs at `time` [s] and the inputs of the step that led to them. Does not allocate or
  /// lock; must be called from a single thread.
  void push(double time, std::span<const double> inputs, std::span<const double> outputs) noexcept;

  /// Writes all rows and closes the file.
  void finish();

  // After `finish`:
  long rows() const noexcept { return rows_; }  ///< written to the system
  /// Rows lost because the ring was full or the system failed to write them.
  long lost() const noexcept { return lost_.load(std::memory_order_relaxed); }
  /// The first error of the system while writing; 0: none.
  int error() const noexcept { return error_; }

 private:
  void loop();
  void drain();

  int descriptor_ = -1;
  bool wait_;
  std::size_t width_, capacity_;
  std::vector<double> ring_;                       ///< capacity_ rows of width_ numbers
  std::atomic<std::size_t> written_{0}, read_{0};  ///< rows put in, rows taken out
  std::atomic<long> lost_{0};
  std::atomic<bool> broken_{false};
  std::string text_;
  long rows_ = 0;
  int error_ = 0;
  bool replaces_ = false;  ///< an existing file, truncated by the first row
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  std::thread thread_;
};

}  // namespace floatframe
