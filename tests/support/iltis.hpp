#pragma once
// The Iltis of examples/iltis with parameters changed, and look-ups in its statics by name.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "floatframe/math/so3.hpp"
#include "floatframe/model_file/model_reader.hpp"
#include "floatframe/run/run.hpp"
#include "floatframe/start/statics.hpp"
#include "support/figures.hpp"

namespace floatframe::test {

inline ModelDescription iltis(const std::vector<ParameterOverride>& overrides = {}) {
  return read_model(FLOATFRAME_EXAMPLES "/iltis/iltis.yaml", overrides);
}

inline const StaticsForce& force_of(const StaticsResult& s, const std::string& name) {
  for (const StaticsForce& f : s.forces)
    if (f.name == name) return f;
  throw std::runtime_error("no force element " + name);
}
inline const StaticsJoint& joint_of(const StaticsResult& s, const std::string& name) {
  for (const StaticsJoint& j : s.joints)
    if (j.name == name) return j;
  throw std::runtime_error("no joint " + name);
}
inline const StaticsBody& body_of(const StaticsResult& s, const std::string& name) {
  for (const StaticsBody& b : s.bodies)
    if (b.name == name) return b;
  throw std::runtime_error("no body " + name);
}

/// `value` rounds to the printed figure `printed` of `decimals` decimals.
inline void expect_digits(const std::string& name, double value, double printed, int decimals) {
  figure(name, value);
  EXPECT_NEAR(value, printed, 0.5000001 * std::pow(10.0, -decimals)) << name;
}

}  // namespace floatframe::test
