// Every field of a flexible body of bars, one change at a time.
#include <gtest/gtest.h>

#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, FlexibleBodiesOfBars) {
  check({
      {[](D& d) { bars(d).young = 0.0; }, "bodies.arm.flexible.material.young: out_of_range"},
      {[](D& d) { bars(d).poisson = 0.5; }, "bodies.arm.flexible.material.poisson: out_of_range"},
      {[](D& d) { bars(d).density = nan; }, "bodies.arm.flexible.material.density: out_of_range"},
      {[](D& d) { bars(d).damping = 2.0; }, "bodies.arm.flexible.damping: out_of_range"},
      {[](D& d) { bars(d).mass_model = static_cast<MassModel>(7); },
       "bodies.arm.flexible.mass_model: wrong_value"},
      {[](D& d) { bars(d).section_inertia = true; },
       "bodies.arm.flexible.section_inertia: contradiction"},
      {[](D& d) { bars(d).points["b"].x() = nan; },
       "bodies.arm.flexible.points.b[1]: out_of_range"},
      {[](D& d) { bars(d).bars.clear(); }, "bodies.arm.flexible.bars: missing"},
      {[](D& d) { bars(d).bars[1].name = "o ne"; }, "wrong_value"},
      {[](D& d) { bars(d).bars[1].elements = 0; },
       "bodies.arm.flexible.bars.two.elements: out_of_range"},
      {[](D& d) { bars(d).bars[0].section = SolidRound{-0.1}; },
       "bodies.arm.flexible.bars.one.section.round: out_of_range"},
      {[](D& d) {
         bars(d).bars[0].section = HollowRound{0.01, 0.01};
       },
       "bodies.arm.flexible.bars.one.section.tube: contradiction"},
      {[](D& d) {
         bars(d).bars[0].section = HollowRound{nan, 0.01};
       },
       "bodies.arm.flexible.bars.one.section.tube[1]: out_of_range"},
      {[](D& d) {
         bars(d).bars[0].section = Rectangle{0.01, 0.0};
       },
       "bodies.arm.flexible.bars.one.section.rectangle[2]: out_of_range"},
      {[](D& d) {
         bars(d).bars[0].section = SectionConstants{1e-4, 1e-8, 0.0, 1e-8};
       },
       "bodies.arm.flexible.bars.one.section.Iz: out_of_range"},
      {[](D& d) {
         bars(d).bars[0].from = "x";
         bars(d).bars.pop_back();
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.one.from: not_found"},
      {[](D& d) {
         bars(d).bars[1].from_bar = "three";
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.two.from.bar: not_found"},
      {[](D& d) {
         bars(d).bars[1].from_fraction = 1.5;
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.two.from.at: out_of_range"},
      {[](D& d) {
         bars(d).bars[1].reference = Vec3::UnitZ();
         bars(d).bars[1].reference.x() = 0.0;
         bars(d).points["c"] = Vec3(0.5, 0, 1);
       },
       "bodies.arm.flexible.bars.two.reference: geometry"},
      {[](D& d) { bars(d).bars[1].reference.setZero(); },
       "bodies.arm.flexible.bars.two.reference: geometry"},
      {[](D& d) {
         bars(d).points["c"] = Vec3(0.5, 0, 0);
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.two: out_of_range"},
      {[](D& d) {
         bars(d).bars[1].from_bar.reset();
         bars(d).bars[1].from = "d";
         bars(d).points["d"] = Vec3(5, 0, 0);
       },
       "bodies.arm.flexible.bars.two: not_found"},
      {[](D& d) { bars(d).masses[0].node = "q"; },
       "bodies.arm.flexible.masses[1].point: not_found"},
      {[](D& d) { bars(d).masses[0].mass = -1.0; },
       "bodies.arm.flexible.masses[1].mass: out_of_range"},
      {[](D& d) { bars(d).clamped[0].mask = 0; },
       "bodies.arm.flexible.clamped[1].dofs: wrong_value"},
      {[](D& d) { bars(d).clamped[0].mask = 31u; }, "bodies.arm.flexible.clamped: singular"},
      {[](D& d) { bars(d).interfaces[0].node = "a"; },
       "bodies.arm.flexible.static_modes[1]: duplicate\nbodies.arm.flexible.static_modes[1]: "
       "duplicate"},
      {[](D& d) { bars(d).normal_modes = -1; }, "bodies.arm.flexible.normal_modes: out_of_range"},
      {[](D& d) { bars(d).normal_modes = 1000; }, "bodies.arm.flexible.normal_modes: out_of_range"},
      {[](D& d) { bars(d).max_frequency = nan; },
       "bodies.arm.flexible.normal_modes.below: out_of_range"},
      {[](D& d) {
         bars(d).normal_modes = 0;
         bars(d).interfaces.clear();
       },
       "bodies.arm.flexible: missing"},
      {[](D& d) {
         bars(d).analytic = AnalyticShapes{51};
         bars(d).bars.pop_back();
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.analytic.dynamic_per_plane: out_of_range"},
      {[](D& d) { bars(d).analytic = AnalyticShapes{1}; },
       "bodies.arm.flexible.analytic: wrong_value"},
      {[](D& d) { bars(d).basis = MatX::Constant(42, 1, nan); },
       "bodies.arm.flexible.basis: not_finite"},
      {[](D& d) { bars(d).basis = MatX::Constant(41, 1, 1.0); }, "wrong_count"},
  });
}

}  // namespace
}  // namespace floatframe
