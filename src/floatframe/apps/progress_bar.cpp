#include "floatframe/apps/progress_bar.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace floatframe {

ProgressBar::ProgressBar(bool enabled, double total, std::string unit)
    : active_(enabled && ::isatty(STDERR_FILENO) == 1),
      total_(total),
      unit_(std::move(unit)),
      start_(std::chrono::steady_clock::now()) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(double fraction) {
  fraction = std::clamp(fraction, 0.0, 1.0);
  show(fraction, fmt::format("{:.4g} of {:.4g} {}", fraction * total_, total_, unit_));
}

void ProgressBar::show(double fraction, const std::string& text, double before) {
  if (!active_) return;
  constexpr int cells = 40;
  fraction = std::clamp(fraction, 0.0, 1.0);
  const int full = static_cast<int>(fraction * cells);
  const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start_;
  std::string rest;
  // The estimated remaining time is meaningless at the very start and useless in short runs.
  if (fraction - before > 0.02 * (1.0 - before) && passed.count() > 1.0) {
    rest = fmt::format(", {:.0f} s to go", passed.count() * (1.0 - fraction) / (fraction - before));
  }
  const std::string line = fmt::format("\r[{}{}] {}{}\x1b[K", std::string(full, '#'),
                                       std::string(cells - full, '.'), text, rest);
  std::fwrite(line.data(), 1, line.size(), stderr);
  std::fflush(stderr);
  drawn_ = true;
}

void ProgressBar::clear() {
  if (!drawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  drawn_ = false;
}

}  // namespace floatframe
