#include "floatframe/roads/two_tracks.hpp"

#include <algorithm>
#include <cassert>

namespace floatframe {

SurfacePoint tracks_height(const TwoTracks& tracks, double x, double y) noexcept {
  assert(tracks.width > 0.0);
  const PiecewisePolynomial::Value l = tracks.left(x), r = tracks.right(x);
  const double w = tracks.width, t = (y - tracks.centre) / w + 0.5;
  const double in = t > 0.0 && t < 1.0 ? 1.0 : 0.0, s = std::clamp(t, 0.0, 1.0);
  const double b = s * s * (3.0 - 2.0 * s), db = 6.0 * s * (1.0 - s) / w,
               ddb = in * (6.0 - 12.0 * s) / (w * w);
  SurfacePoint out;
  out.z = r.f + b * (l.f - r.f);  // (1)
  out.zx = r.df + b * (l.df - r.df);
  out.zy = db * (l.f - r.f);
  out.zxx = r.ddf + b * (l.ddf - r.ddf);
  out.zxy = db * (l.df - r.df);
  out.zyy = ddb * (l.f - r.f);
  return out;
}

}  // namespace floatframe
