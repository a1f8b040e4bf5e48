#include "floatframe/analyses/complex_curves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace floatframe {

double phase_of(std::complex<double> value) { return 180.0 / std::numbers::pi * std::arg(value); }

ComplexParts parts_of(const std::vector<std::complex<double>>& values, bool at_rest) {
  ComplexParts out;
  const auto moves = [](const std::complex<double>& v) { return std::abs(v) > 0.0; };
  auto first = at_rest ? std::find_if(values.begin(), values.end(), moves) : values.begin();
  if (first == values.end()) first = values.begin();
  for (auto v = values.begin(); v != values.end(); ++v) {
    const double phase = phase_of(v < first ? *first : *v);
    out.size.push_back(std::abs(*v));
    out.phase.push_back(
        v <= first ? phase : out.phase.back() + std::remainder(phase - out.phase.back(), 360.0));
    out.real.push_back(v->real());
    out.imaginary.push_back(v->imag());
  }
  return out;
}

}  // namespace floatframe
