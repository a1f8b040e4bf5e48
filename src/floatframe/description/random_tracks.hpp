#pragma once
// Two random tracks of one road (road_spectrum.hpp), a width w apart: both have the spectrum G(n),
// and the cross spectrum G(n) g(n) with the real coherence 0 <= g <= 1 (its square is what
// estimators call coherence):
//   isotropic    g = s K_1(s), s = 2 pi n w: of a surface that is alike in all directions, with
//                sections of the spectrum n^-2 (Dodds and Robson, J. Sound Vib. 31, 1973), K_1
//                the modified Bessel function of the second kind
//   exponential  g = exp(-mu n w)
// Each wave of the left track has one on the right of the same amplitude, shifted by arccos g(n),
// to one side and to the other in turn from wave to wave. So the spectra are exact on both tracks,
// the real part of the cross spectrum is G g wave by wave, and its imaginary part vanishes over any
// two neighbours: mean squares of linear responses are those of the spectrum.
#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/roads/two_tracks.hpp"

namespace floatframe {

enum class TrackCoherence { isotropic, exponential };
inline constexpr const char* track_coherence_words[] = {"isotropic", "exponential"};

struct TrackSpectrum {
  RoadSpectrum road;    ///< of each track; the left one is `random_road` of it
  double width = 1.5;   ///< w [m]
  double centre = 0.0;  ///< y in the middle [m]
  TrackCoherence coherence = TrackCoherence::isotropic;
  double decay = 1.0;  ///< mu [-], of the exponential one
};

/// g(n); n in cycles/m.
double track_coherence(const TrackSpectrum& spectrum, double n);

/// Waves of both tracks, pair by pair.
struct TrackWaves {
  std::vector<RoadWave> left, right;
};
TrackWaves track_waves(const TrackSpectrum& spectrum);

/// Equal arguments give the same road on every machine up to rounding. Throws InputError as
/// `random_road`, or if width is not positive or decay is negative.
TwoTracks random_tracks(const TrackSpectrum& spectrum);

}  // namespace floatframe
