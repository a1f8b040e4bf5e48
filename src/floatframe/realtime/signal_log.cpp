#include "floatframe/realtime/signal_log.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <iterator>
#include <utility>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/csv_field.hpp"
#include "floatframe/core/output_place.hpp"

namespace floatframe {
namespace {

/// Size of the ring: seconds of a fast model, to bridge delays of the disk.
constexpr std::size_t ring_numbers = 1 << 20;
constexpr std::size_t fewest_rows = 64;

std::string header(const Model& model) {
  std::string text = csv_title("time", "s");
  for (const Input& input : model.inputs)
    text += ',' + csv_title("input." + input.name, input.unit);
  for (const Output& output : model.outputs) text += ',' + csv_title(output.name, output.unit);
  return text + '\n';
}

}  // namespace

SignalLog::SignalLog(const Model& model, const std::string& path, bool wait)
    : wait_(wait),
      width_(1 + model.inputs.size() + model.outputs.size()),
      capacity_(std::max(fewest_rows, ring_numbers / width_)),
      ring_(capacity_ * width_, 0.0) {
  // A pipe without a reader is an error instead of an endless wait. An open file is written at its
  // current position; an existing log is kept until the first row of the new one.
  const OutputPlace place = output_place(path);
  descriptor_ = place.descriptor >= 0
                    ? fcntl(place.descriptor, F_DUPFD_CLOEXEC, 0)
                    : open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
  struct stat status {};
  replaces_ = place.descriptor < 0 && descriptor_ >= 0 && fstat(descriptor_, &status) == 0 &&
              S_ISREG(status.st_mode) && status.st_size > 0;
  if (descriptor_ < 0)
    throw OutputError(fmt::format("'{}' cannot be written: {}", path, std::strerror(errno)));
  if (place.descriptor < 0) fcntl(descriptor_, F_SETFL, fcntl(descriptor_, F_GETFL) & ~O_NONBLOCK);
  text_ = header(model);
  thread_ = std::thread([this] { loop(); });
}

SignalLog::~SignalLog() { finish(); }

void SignalLog::push(double time, std::span<const double> inputs,
                     std::span<const double> outputs) noexcept {
  const std::size_t row = written_.load(std::memory_order_relaxed);
  while (row - read_.load(std::memory_order_acquire) == capacity_) {
    if (!wait_ || broken_.load(std::memory_order_relaxed)) {
      lost_.fetch_add(1, std::memory_order_relaxed);
      return;
    }
    usleep(200);
  }
  double* at = ring_.data() + row % capacity_ * width_;
  *at++ = time;
  at = std::copy(inputs.begin(), inputs.end(), at);
  std::copy(outputs.begin(), outputs.end(), at);
  written_.store(row + 1, std::memory_order_release);
}

void SignalLog::finish() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  thread_.join();
  if (close(descriptor_) != 0 && error_ == 0) error_ = errno;
}

void SignalLog::loop() {
  // A reader that closes the pipe is an error of `write`, not the end of the program.
  sigset_t pipe;
  sigemptyset(&pipe);
  sigaddset(&pipe, SIGPIPE);
  pthread_sigmask(SIG_BLOCK, &pipe, nullptr);
  std::unique_lock lock(mutex_);
  bool last = false;
  while (!last) {
    last = ended_.wait_for(lock, std::chrono::milliseconds(50), [this] { return end_; });
    drain();
  }
}

void SignalLog::drain() {
  const std::size_t end = written_.load(std::memory_order_acquire);
  std::size_t row = read_.load(std::memory_order_relaxed);
  long pending = 0;  // rows in text_
  const auto put = [this, &pending] {
    if (std::exchange(replaces_, false) && ftruncate(descriptor_, 0) != 0) error_ = errno;
    for (std::size_t done = 0; done < text_.size() && error_ == 0;) {
      const ssize_t n = write(descriptor_, text_.data() + done, text_.size() - done);
      if (n >= 0)
        done += n;
      else if (errno != EINTR)
        error_ = errno;
    }
    if (error_ == 0) {
      rows_ += pending;
    } else {
      lost_.fetch_add(pending, std::memory_order_relaxed);
      broken_.store(true, std::memory_order_relaxed);
    }
    pending = 0;
    text_.clear();
  };
  for (; row < end; ++row) {
    if (error_ == 0) {
      const double* x = ring_.data() + row % capacity_ * width_;
      for (std::size_t c = 0; c < width_; ++c)
        fmt::format_to(std::back_inserter(text_), "{}{:.17g}", c == 0 ? "" : ",", x[c]);
      text_ += '\n';
      ++pending;
      if (text_.size() > (1 << 16)) put();
    } else {
      lost_.fetch_add(1, std::memory_order_relaxed);
    }
    read_.store(row + 1, std::memory_order_release);
  }
  if (!text_.empty() && (pending > 0 || !replaces_)) put();
}

}  // namespace floatframe
