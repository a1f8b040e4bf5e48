#include "floatframe/analyses/rotor_options.hpp"

#include <fmt/format.h>

#include <charconv>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/json_text.hpp"

namespace floatframe {

SpeedRange speed_range(const std::string& option, const std::string& text) {
  const auto bad = [&] {
    return InputError(
        ErrorCode::wrong_value,
        fmt::format("{}: found '{}', expected JOINT=FROM:TO:STEP [rad/s], as in motor=0:1200:40",
                    option, excerpt(text)));
  };
  SpeedRange r;
  const std::size_t equals = text.rfind('=');
  if (equals == std::string::npos || equals == 0) throw bad();
  r.joint = text.substr(0, equals);
  double* const numbers[] = {&r.from, &r.to, &r.step};
  const char* at = text.data() + equals + 1;
  const char* const end = text.data() + text.size();
  for (int k = 0; k < 3; ++k) {
    const auto [rest, error] = std::from_chars(at, end, *numbers[k]);
    const bool last = k == 2;
    if (error != std::errc() || (last ? rest != end : rest == end || *rest != ':')) throw bad();
    at = rest + 1;
  }
  return r;
}

}  // namespace floatframe
