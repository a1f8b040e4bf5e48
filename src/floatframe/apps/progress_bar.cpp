#include "floatframe/apps/progress_bar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "floatframe/apps/terminal.hpp"

namespace floatframe {
namespace {

/// "12 s", "3 min 20 s", "5 h 12 min".
std::string time_text(double seconds) {
  if (seconds < 119.5) return fmt::format("{:.0f} s", seconds);
  if (!(seconds < 1e9)) return "long";
  const long whole = std::lround(seconds);
  if (whole < 7200) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

ProgressBar::ProgressBar(bool enabled, double total, std::string unit)
    : active_(enabled && terminal_width(Stream::error) > 0),
      total_(total),
      unit_(std::move(unit)),
      start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::restart() { start_ = std::chrono::steady_clock::now(); }

void ProgressBar::show(double fraction) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  show(fraction, unit_ == "%"
                     ? std::string()
                     : fmt::format("{:.4g} of {:.4g} {}", fraction * total_, total_, unit_));
}

void ProgressBar::show(double fraction, const std::string& text, double before) {
  if (!active_) return;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  std::string words = text + (text.empty() ? "" : ", ") + fmt::format("{:.0f} %", 100.0 * fraction);
  // The estimated remaining time is meaningless at the very start and useless in short runs.
  if (fraction - before > 0.02 * (1.0 - before) && passed.count() > 1.0)
    words += ", " + time_text(passed.count() * (1.0 - fraction) / (fraction - before)) + " to go";
  // One character less than the line, where the cursor stands.
  const std::size_t width = std::max<std::size_t>(terminal_width(Stream::error), 20) - 1;
  const std::size_t used = words.size() + 3;
  const std::size_t cells = used < width ? std::min<std::size_t>(40, width - used) : 0;
  const auto full = static_cast<std::size_t>(fraction * static_cast<double>(cells));
  std::string line =
      fmt::format("[{}{}] {}", std::string(full, '#'), std::string(cells - full, '.'), words);
  if (cells < 5) line = words;  // no room for a bar
  if (line.size() > width) line.resize(width);
  line = '\r' + line + "\x1b[K";
  write_error(line);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

ProgressListener progress_on_terminal(bool enabled) {
  using Clock = std::chrono::steady_clock;
  const auto bar = std::make_shared<ProgressBar>(enabled, 1.0, "");
  // Works follow each other; of each the time to go is estimated from where it was first heard of.
  return [bar, next = Clock::now() + std::chrono::seconds(1), last = std::string(), first = 0.0](
             const char* work, double done) mutable {
    if (work != last || done < first) {
      last = work;
      first = done;
      bar->restart();
    }
    if (Clock::now() < next) return;
    next = Clock::now() + std::chrono::milliseconds(100);
    bar->show(done, work, first);
  };
}

}  // namespace floatframe
