// Measures over dual numbers: the value is that over doubles, the derivatives are those of central
// differences, for random motions of the markers.
#include <gtest/gtest.h>

#include <random>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/math/so3.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/output_kind.hpp"

namespace floatframe {
namespace {

/// A body with a node, a marker on it and one on its frame; a joint of each type.
Model measured_model() {
  Model model;
  FlexibleBody data;
  data.nodes.push_back({"tip", Vec3(0.7, -0.2, 0.4), Mat3X(3, 0), Mat3X(3, 0)});
  Body body;
  body.data = std::make_shared<const FlexibleBody>(std::move(data));
  body.X_WB.R = rotation_exp(Vec3(0.3, -0.8, 0.5));
  model.bodies.push_back(std::move(body));
  Marker node;
  node.body = node.node = 0;
  model.markers.push_back(node);
  for (const JointType type : joint_types) {
    Joint joint;
    joint.type = type;
    joint.axis_2 = Vec3(0.6, 0.0, 0.8);
    model.joints.push_back(joint);
  }
  return model;
}

struct RandomMarkers {
  std::mt19937 random{7};
  std::uniform_real_distribution<double> number{-1.0, 1.0};
  Vec3 vector() { return {number(random), number(random), number(random)}; }
  MarkerState marker() {
    MarkerState m;
    m.r = vector();
    m.R = rotation_exp(vector());
    m.v = vector();
    m.w = vector();
    return m;
  }
};

/// Moved in the direction k of (dr, dpi, v, w), R_new = exp(skew(dpi)) R.
MarkerState moved(MarkerState m, int k, double h) {
  const Vec3 step = h * Vec3::Unit(k % 3);
  if (k < 3)
    m.r += step;
  else if (k < 6)
    m.R = rotation_exp(step) * m.R;
  else if (k < 9)
    m.v += step;
  else
    m.w += step;
  return m;
}

MarkerMotion<Dual> dual(const MarkerState& m, bool varied) {
  MarkerMotion<Dual> x{m.r.cast<Dual>(), m.R.cast<Dual>(), m.v.cast<Dual>(), m.w.cast<Dual>()};
  for (int k = 0; varied && k < 3; ++k) {
    x.r[k].d[k] = x.v[k].d[6 + k] = x.w[k].d[9 + k] = 1.0;
    const Mat3 dR = skew(Vec3::Unit(k)) * m.R;
    for (int i = 0; i < 9; ++i) x.R(i).d[3 + k] = dR(i);
  }
  return x;
}

/// `frames`: with the frame that the motion is relative to, with axes.
void compare(const Model& model, const Output& output, bool relative, bool axes) {
  const OutputKind& kind = output_kind(output.type);
  RandomMarkers random;
  MarkerState m[4];
  for (MarkerState& x : m) x = random.marker();
  const bool used[] = {true, true, relative, axes};
  const auto ports = [&]<class S, class Marker>(S, const Marker* x) {
    return MeasurePorts<S>{
        model,         output, x, x + 1, relative ? x + 2 : nullptr, axes ? x + 3 : nullptr,
        Vec3(1, 2, 3), 4.0};
  };
  const double value = kind.value(ports(0.0, m));
  for (int i = 0; i < 4; ++i) {
    if (!used[i]) continue;
    MarkerMotion<Dual> x[4];
    for (int j = 0; j < 4; ++j) x[j] = dual(m[j], i == j);
    const Dual found = kind.dual(ports(Dual(), x));
    EXPECT_NEAR(found.v, value, 1e-14 * (1.0 + std::abs(value)));
    for (int k = 0; k < 12; ++k) {
      MarkerState ahead[4], behind[4];
      std::copy(m, m + 4, ahead);
      std::copy(m, m + 4, behind);
      ahead[i] = moved(m[i], k, 1e-5);
      behind[i] = moved(m[i], k, -1e-5);
      const double slope = (kind.value(ports(0.0, ahead)) - kind.value(ports(0.0, behind))) / 2e-5;
      EXPECT_NEAR(found.d[k], slope, 1e-8) << output_type_name(output.type) << ' '
                                           << output.component << " marker " << i << ' ' << k;
    }
  }
}

TEST(Measures, HaveTheDerivativesOfTheirValues) {
  const Model model = measured_model();
  int kinds = 0;
  for (const OutputType type : output_types) {
    const OutputKind& kind = output_kind(type);
    EXPECT_EQ(kind.value != nullptr, kind.dual != nullptr);
    if (!kind.value) continue;
    ++kinds;
    Output output;
    output.type = type;
    output.marker = 0;
    const bool joint = kind.of == OutputOf::joint, elastic = kind.of == OutputOf::flexible_point;
    for (std::size_t j = 0; j < (joint ? model.joints.size() : 1); ++j) {
      if (joint) output.joint = static_cast<int>(j);
      const int n = joint                 ? joint_velocities(model.joints[j].type)
                    : kind.components.key ? static_cast<int>(kind.components.words.size())
                                          : 1;
      for (output.component = 0; output.component < n; ++output.component) {
        compare(model, output, elastic, false);
        if (kind.frames == OutputFrames::none) continue;
        compare(model, output, true, true);
        if (!elastic) compare(model, output, false, true);
      }
    }
  }
  EXPECT_EQ(kinds, 11);
}

}  // namespace
}  // namespace floatframe
