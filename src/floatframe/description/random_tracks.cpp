#include "floatframe/description/random_tracks.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/rules.hpp"

namespace floatframe {

double track_coherence(const TrackSpectrum& spectrum, double n) {
  if (spectrum.coherence == TrackCoherence::exponential)
    return std::exp(-spectrum.decay * n * spectrum.width);
  const double s = 2.0 * std::numbers::pi * n * spectrum.width;
  if (s < 1e-8) return 1.0;
  return s < 700.0 ? std::min(s * std::cyl_bessel_k(1.0, s), 1.0) : 0.0;
}

TrackWaves track_waves(const TrackSpectrum& spectrum) {
  TrackWaves out{road_waves(spectrum.road), {}};
  out.right = out.left;
  double side = 1.0;
  for (RoadWave& wave : out.right) {
    const double n = wave.k / (2.0 * std::numbers::pi);
    wave.phase += side * std::acos(track_coherence(spectrum, n));
    side = -side;
  }
  return out;
}

TwoTracks random_tracks(const TrackSpectrum& spectrum) {
  check_spectrum(spectrum.road);
  if (const auto complaint = rules::track_width.complaint(spectrum.width))
    throw InputError(ErrorCode::out_of_range, "random tracks: width: " + *complaint);
  if (const auto complaint = rules::track_decay.complaint(spectrum.decay))
    throw InputError(ErrorCode::out_of_range, "random tracks: decay: " + *complaint);
  const TrackWaves waves = track_waves(spectrum);
  return {road_of_waves(spectrum.road, waves.left), road_of_waves(spectrum.road, waves.right),
          spectrum.width, spectrum.centre};
}

}  // namespace floatframe
