#pragma once
// Out-of-plane frequencies of a uniform cantilever that turns about its root (Wright, Smith,
// Thresher, Wang, J. Appl. Mech. 49 (1982) 197, computed to ten digits): speed, first and third
// frequency, all times sqrt(rho A L^4 / EI). In the plane mu^2 is less by the square of the speed.

namespace floatframe::test {

struct TurningBeam {
  double speed, first, third;
};

inline constexpr TurningBeam turning_beam[] = {
    {0, 3.516015268, 61.69721441}, {1, 3.681646814, 61.84176259}, {2, 4.137319573, 62.27318411},
    {3, 4.797278532, 62.98496748}, {4, 5.585001421, 63.96676049}, {5, 6.449544749, 65.20504052},
    {6, 7.360373019, 66.68391438}, {7, 8.299636928, 68.38595069}, {8, 9.256837601, 70.29296219},
    {9, 10.22568628, 72.38668067}, {10, 11.20232776, 74.6492946}, {12, 13.17015049, 79.61447849}};

}  // namespace floatframe::test
