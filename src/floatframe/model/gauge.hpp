#pragma once
// Gauges: stress, strain and section forces at places of a body (BodyStress) as outputs.
// The data of an instant are prepared when the model is built; a value is
//   rows = modes y + loads c
// with the amplitudes y and the load coefficients c of the body. Strain along a unit direction d of
// the body, as measured by a strain gauge:
//   eps = d . ((1 + nu) s - nu tr(s) I) d / E
#include <string>
#include <vector>

#include "floatframe/body/body_stress.hpp"
#include "floatframe/description/description.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

struct FlexibleBody;
struct Model;
struct SystemMotion;

struct Gauge {
  int body = -1;
  int place = -1, section = -1;   ///< of BodyStress: one of the two
  bool inertia_loads = true;      ///< false: by the modes alone
  Vec3 direction = Vec3::Zero();  ///< of a strain, body axes; zero: stress
  /// 6 x nm and 6 x (12 + nm) or empty; of a strain row 0.
  Eigen::Matrix<double, 6, Eigen::Dynamic> modes, loads;
};

/// Rows at the location of the gauge: computed again when its modes change.
void fill_rows(const FlexibleBody& body, Gauge& gauge);

using BodyLoadCoefficients = Eigen::Matrix<double, body_load_cases, 1>;
/// c of the whole body, without those of its modes.
BodyLoadCoefficients body_load_coefficients(const SystemMotion& motion, int body) noexcept;
/// At an instant: xx yy zz xy yz zx, or N Vy Vz T My Mz, or the strain in row 0.
Vec6 gauge_values(const SystemMotion& motion, const Gauge& gauge) noexcept;

/// Sentences about outputs, starting with the given one, whose gauge is where the model of the part
/// is stiffer than the part.
std::vector<std::string> doubtful_gauges(const Model& model, std::size_t first_output = 0);

double von_mises(const Vec6& stress) noexcept;
/// Descending. Closed form (Smith 1961), also for equal values.
Vec3 principal_stresses(const Vec6& stress) noexcept;

}  // namespace floatframe
