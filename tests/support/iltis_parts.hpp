#pragma once
// The three flexible parts of the Iltis as finite-element models in their body frames (design of
// the left front corner).
#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe::test {

inline const Material iltis_steel{2e11, 0.3, 7500.0};

/// A-arm: two bars and the stub that carries the shock absorber; frame at the middle of the hinge
/// axis.
inline BarFrame a_arm_frame(int elements) {
  const Vec3 origin(0.970, 0.259, -0.268);
  const auto local = [&](double x, double y, double z) { return Vec3(Vec3(x, y, z) - origin); };
  BarFrame frame;
  frame.material = iltis_steel;
  frame.points = {{"front", local(1.070, 0.259, -0.268)},
                  {"rear", local(0.870, 0.259, -0.268)},
                  {"ball", local(0.970, 0.572, -0.341)},
                  {"shock", local(1.045, 0.500, -0.329)}};
  const BeamSection section = BeamSection::solid_round(0.03737837);  // 6 kg
  frame.bars.resize(3);
  frame.bars[0] = {"front bar", "ball", "front", "", 0.0, elements, section, Vec3::UnitZ()};
  frame.bars[1] = {"rear bar", "ball", "rear", "", 0.0, elements, section, Vec3::UnitZ()};
  frame.bars[2] = {"stub", "", "shock", "front bar", 0.2, 1, section, Vec3::UnitZ()};
  return frame;
}

inline ReductionOptions a_arm_options() {
  ReductionOptions options;
  options.clamped = {{"front", all_dofs}, {"rear", all_dofs}};
  options.interfaces = {{"shock", 4u}, {"ball", 4u}};
  options.normal_modes = 2;
  return options;
}

/// Straight bar along x from "inner" to "outer".
inline BarFrame straight_bar(double length, double diameter, int elements) {
  BarFrame frame;
  frame.material = iltis_steel;
  frame.points = {{"inner", Vec3::Zero()}, {"outer", Vec3(length, 0.0, 0.0)}};
  frame.bars.resize(1);
  frame.bars[0] = {
      "bar",        "inner", "outer", "", 0.0, elements, BeamSection::solid_round(diameter),
      Vec3::UnitZ()};
  return frame;
}

}  // namespace floatframe::test
