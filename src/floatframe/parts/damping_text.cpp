#include "floatframe/parts/damping_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/text_pieces.hpp"

namespace floatframe {
namespace {

[[noreturn]] void fail_damping(const std::string& text) {
  throw InputError(
      ErrorCode::wrong_value,
      fmt::format("--damping: found '{}', expected a fraction of critical damping such as 0.02, a "
                  "list of them, bands:usual, bands:100=0.01,1000=0.1,1 or rayleigh:ALPHA,BETA, "
                  "and behind it ,reference=frame, free or mounted, ,frequency=HZ",
                  text));
}

double damping_number(const std::string& text, const std::string& whole) {
  const auto x = finite_number(text);
  if (!x) fail_damping(whole);
  return *x;
}

/// "100=0.01"
DampingBand damping_band(const std::string& text, const std::string& whole) {
  DampingBand band;
  const std::size_t equal = text.find('=');
  if (equal != std::string::npos) band.below = damping_number(text.substr(0, equal), whole);
  band.fraction = damping_number(equal == std::string::npos ? text : text.substr(equal + 1), whole);
  return band;
}

}  // namespace

std::string damping_text(const ModalDamping& d) {
  std::string text;
  if (d.alpha != 0.0 || d.beta != 0.0) {
    text = fmt::format("rayleigh:{},{}", d.alpha, d.beta);
  } else if (!d.bands.empty()) {
    std::vector<std::string> bands;
    for (const DampingBand& band : d.bands)
      bands.push_back(std::isfinite(band.below) ? fmt::format("{}={}", band.below, band.fraction)
                                                : fmt::format("{}", band.fraction));
    text = fmt::format("bands:{}", fmt::join(bands, ","));
  } else if (!d.none()) {
    text = fmt::format("{}", fmt::join(d.fractions, ","));
  }
  if (text.empty()) return text;
  if (d.reference != DampingReference::frame)
    text += fmt::format(",reference={}", word(d.reference));
  if (d.interface_frequency != 0.0) text += fmt::format(",frequency={}", d.interface_frequency);
  return text;
}

ModalDamping damping_argument(const std::string& text) {
  ModalDamping d;
  const bool rayleigh = text.starts_with("rayleigh:"), bands = text.starts_with("bands:");
  const std::string rest = rayleigh || bands ? text.substr(text.find(':') + 1) : text;
  std::vector<std::string> values;
  for (const std::string& piece : pieces_of(rest, ',')) {
    if (piece.starts_with("reference=")) {
      const std::string name = piece.substr(10);
      bool known = false;
      for (const auto reference :
           {DampingReference::frame, DampingReference::free, DampingReference::mounted})
        if (name == word(reference)) d.reference = reference, known = true;
      if (!known) fail_damping(text);
    } else if (piece.starts_with("frequency=")) {
      d.interface_frequency = damping_number(piece.substr(10), text);
      if (!(d.interface_frequency > 0.0)) fail_damping(text);
    } else {
      values.push_back(piece);
    }
  }
  if (values.empty() || (rayleigh && values.size() != 2)) fail_damping(text);
  if (rayleigh) {
    d.alpha = damping_number(values[0], text);
    d.beta = damping_number(values[1], text);
  } else if (bands && values == std::vector<std::string>{"usual"}) {
    d.bands = usual_damping_bands();
  } else {
    for (const std::string& value : values)
      if (bands)
        d.bands.push_back(damping_band(value, text));
      else
        d.fractions.push_back(damping_number(value, text));
  }
  if (const auto complaint = damping_complaint(d))
    throw InputError(ErrorCode::out_of_range, "--damping: " + *complaint);
  return d;
}

}  // namespace floatframe
