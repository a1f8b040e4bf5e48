// Every field of a flexible body of bars, one change at a time.
#include <gtest/gtest.h>

#include "support/valid_description.hpp"

namespace floatframe {
namespace {

using namespace test;

TEST(Validate, FlexibleBodiesOfBars) {
  check({
      {[](D& d) { bars(d).young = 0.0; },
       "bodies.arm.flexible.material.young: found 0, expected a positive number [Pa]"},
      {[](D& d) { bars(d).poisson = 0.5; },
       "bodies.arm.flexible.material.poisson: found 0.5, expected a number above -1 and below "
       "0.5"},
      {[](D& d) { bars(d).density = nan; },
       "bodies.arm.flexible.material.density: found nan, expected a positive number [kg/m3] "
       "(numbers must be finite)"},
      {[](D& d) { bars(d).damping = 2.0; },
       "bodies.arm.flexible.damping: found 2, expected a fraction of critical damping from 0 to "
       "1"},
      {[](D& d) { bars(d).mass_model = static_cast<MassModel>(7); },
       "bodies.arm.flexible.mass_model: found 7, expected isoparametric, six_dof or hermite"},
      {[](D& d) { bars(d).section_inertia = true; },
       "bodies.arm.flexible.section_inertia: found true with the isoparametric mass model, "
       "expected mass_model six_dof or hermite"},
      {[](D& d) { bars(d).points["b"].x() = nan; },
       "bodies.arm.flexible.points.b[1]: found nan, expected a number [m] (numbers must be "
       "finite)"},
      {[](D& d) { bars(d).bars.clear(); },
       "bodies.arm.flexible.bars: found no bars, expected at least one"},
      {[](D& d) { bars(d).bars[1].name = "o ne"; },
       "bodies.arm.flexible.bars: found the name 'o ne', expected letters, digits, _ and -, with "
       "a letter first"},
      {[](D& d) { bars(d).bars[1].elements = 0; },
       "bodies.arm.flexible.bars.two.elements: found 0, expected a number of elements (a whole "
       "number from 1 to 100000)"},
      {[](D& d) { bars(d).bars[0].section = SolidRound{-0.1}; },
       "bodies.arm.flexible.bars.one.section.round: found -0.1, expected a positive number [m]"},
      {[](D& d) {
         bars(d).bars[0].section = HollowRound{0.01, 0.01};
       },
       "bodies.arm.flexible.bars.one.section.tube: found the inner diameter 0.01, expected less "
       "than the outer one, 0.01 [m]"},
      {[](D& d) {
         bars(d).bars[0].section = HollowRound{nan, 0.01};
       },
       "bodies.arm.flexible.bars.one.section.tube[1]: found nan, expected a positive number [m] "
       "(numbers must be finite)"},
      {[](D& d) {
         bars(d).bars[0].section = Rectangle{0.01, 0.0};
       },
       "bodies.arm.flexible.bars.one.section.rectangle[2]: found 0, expected a positive number "
       "[m]"},
      {[](D& d) {
         bars(d).bars[0].section = SectionConstants{1e-4, 1e-8, 0.0, 1e-8};
       },
       "bodies.arm.flexible.bars.one.section.Iz: found 0, expected a positive number [m4]"},
      {[](D& d) {
         bars(d).bars[0].from = "x";
         bars(d).bars.pop_back();
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.one.from: unknown point 'x'"},
      {[](D& d) {
         bars(d).bars[1].from_bar = "three";
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.two.from.bar: unknown bar 'three' (a bar must be defined before "
       "it is "
       "used)"},
      {[](D& d) {
         bars(d).bars[1].from_fraction = 1.5;
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.two.from.at: found 1.5, expected a number from 0 to 1"},
      {[](D& d) {
         bars(d).bars[1].reference = Vec3::UnitZ();
         bars(d).bars[1].reference.x() = 0.0;
         bars(d).points["c"] = Vec3(0.5, 0, 1);
       },
       "bodies.arm.flexible.bars.two.reference: found a direction parallel to the bar, expected "
       "another"},
      {[](D& d) { bars(d).bars[1].reference.setZero(); },
       "bodies.arm.flexible.bars.two.reference: found a vector of length zero, expected a "
       "direction"},
      {[](D& d) {
         bars(d).points["c"] = Vec3(0.5, 0, 0);
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.bars.two: found length 0, expected a bar of positive length [m]"},
      {[](D& d) {
         bars(d).bars[1].from_bar.reset();
         bars(d).bars[1].from = "d";
         bars(d).points["d"] = Vec3(5, 0, 0);
       },
       "bodies.arm.flexible.bars.two: the bar is not connected to 'one', expected all bars of a "
       "body to be connected"},
      {[](D& d) { bars(d).masses[0].node = "q"; },
       "bodies.arm.flexible.masses[1].point: found 'q', expected an end point of a bar of this "
       "body"},
      {[](D& d) { bars(d).masses[0].mass = -1.0; },
       "bodies.arm.flexible.masses[1].mass: found -1, expected a number >= 0 [kg]"},
      {[](D& d) { bars(d).clamped[0].mask = 0; },
       "bodies.arm.flexible.clamped[1].dofs: found the mask 0, expected directions: bits 0 to 5 = "
       "x, y, z, rx, ry, rz"},
      {[](D& d) { bars(d).clamped[0].mask = 31u; },
       "bodies.arm.flexible.clamped: these degrees of freedom leave 1 rigid motion of the body "
       "free, expected none"},
      {[](D& d) { bars(d).interfaces[0].node = "a"; },
       "bodies.arm.flexible.static_modes[1]: the direction y of 'a' is named twice in clamped and "
       "static_modes, expected once\n"
       "bodies.arm.flexible.static_modes[1]: the direction z of 'a' is named twice in clamped and "
       "static_modes, expected once"},
      {[](D& d) { bars(d).normal_modes = -1; },
       "bodies.arm.flexible.normal_modes: found -1, expected a number of modes, or {below: "
       "frequency}, (a whole number from 0 to 10000)"},
      {[](D& d) { bars(d).normal_modes = 1000; },
       "bodies.arm.flexible.normal_modes: found 1000 modes, expected at most 21, the number of "
       "degrees of freedom with mass"},
      {[](D& d) { bars(d).max_frequency = nan; },
       "bodies.arm.flexible.normal_modes.below: found nan, expected a positive number [Hz] "
       "(numbers must be finite)"},
      {[](D& d) {
         bars(d).normal_modes = 0;
         bars(d).interfaces.clear();
       },
       "bodies.arm.flexible: found no modes, expected static_modes, normal_modes, analytic or "
       "basis"},
      {[](D& d) {
         bars(d).analytic = AnalyticShapes{51};
         bars(d).bars.pop_back();
         bars(d).masses.clear();
       },
       "bodies.arm.flexible.analytic.dynamic_per_plane: found 51, expected a number of shapes (a "
       "whole number from 0 to 50)"},
      {[](D& d) { bars(d).analytic = AnalyticShapes{1}; },
       "bodies.arm.flexible.analytic: analytic shapes need one straight bar without masses, found "
       "2 bars and 1 masses"},
      {[](D& d) { bars(d).basis = MatX::Constant(42, 1, nan); },
       "bodies.arm.flexible.basis: found numbers that are not finite, expected finite ones"},
      {[](D& d) { bars(d).basis = MatX::Constant(41, 1, 1.0); },
       "bodies.arm: the given basis has 41 rows; 7 nodes need 42"},
  });
}

}  // namespace
}  // namespace floatframe
