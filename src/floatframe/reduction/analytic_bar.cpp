// Analytic shapes of a straight uniform bar clamped at its first node, s = x / L:
//   static tip shape     s^2 (3 - s) / 2,                     k = 3 E I / L^3
//   clamped-pinned n     phi_n(s), tan(beta) = tanh(beta),    k = E I beta^4 / L^3, int_0^1 phi^2
//   ds = 1 phi = cosh(beta s) - cos(beta s) - sigma (sinh(beta s) - sin(beta s)),  sigma =
//   cot(beta)
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe {
namespace {

struct Shape {
  double value, slope;  ///< slope: d/ds
};

Shape static_tip(double s) { return {0.5 * s * s * (3.0 - s), 0.5 * s * (6.0 - 3.0 * s)}; }

/// sigma is close to 1, so cosh - sigma sinh is formed without cancellation:
/// cosh(b s) - sigma sinh(b s) = exp(-b s) + (1 - sigma) sinh(b s), 1 - sigma = -2 / (exp(2 b) -
/// 1).
Shape clamped_pinned(double beta, double s) {
  const double x = beta * s;
  const double rest = -2.0 / std::expm1(2.0 * beta);
  const double sigma = 1.0 - rest;
  // sigma here is coth(beta) = cot(beta) at a root of tan = tanh.
  const double value = std::exp(-x) + rest * std::sinh(x) - std::cos(x) + sigma * std::sin(x);
  const double slope = -std::exp(-x) + rest * std::cosh(x) + std::sin(x) + sigma * std::cos(x);
  return {value, beta * slope};
}

}  // namespace

double clamped_pinned_root(int n) {
  // f = sin(b) - cos(b) tanh(b); the root is just below (n + 1/4) pi.
  double b = (n + 0.25) * std::acos(-1.0);
  for (int i = 0; i < 20; ++i) {
    const double t = std::tanh(b);
    const double f = std::sin(b) - std::cos(b) * t;
    const double df = std::cos(b) + std::sin(b) * t - std::cos(b) * (1.0 - t * t);
    b -= f / df;
  }
  return b;
}

ModeSet analytic_bar_modes(const FeModel& model, int dynamic_per_plane) {
  if (dynamic_per_plane < 0)
    throw InputError(ErrorCode::out_of_range,
                     "the number of analytic shapes per plane must not be negative");
  if (model.elements.empty() || !model.masses.empty()) {
    throw InputError(ErrorCode::unsupported,
                     "analytic shapes need a single straight bar without point masses");
  }
  const FeElement& first = model.elements.front();
  const ElementInput in = gather(model, first);
  const BeamSection section = in.section;
  const Vec3 start = in.p[0];
  const Vec3 axis = (in.p[1] - in.p[0]).normalized();
  double L = 0.0;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const FeElement& element = model.elements[e];
    const int index = static_cast<int>(e);
    if (element.type != FeElementType::beam2) {
      throw InputError(ErrorCode::unsupported, "analytic shapes need beams, but " +
                                                   model.element_label(index) + " is none");
    }
    const ElementInput here = gather(model, element);
    const Vec3 end = here.p[1] - start;
    const bool chained = e == 0 || element.nodes[0] == model.elements[e - 1].nodes[1];
    if (!chained || end.cross(axis).norm() > 1e-9 * end.norm() || end.dot(axis) <= L) {
      throw InputError(ErrorCode::unsupported, "analytic shapes need one straight bar, but " +
                                                   model.element_label(index) + " leaves its line");
    }
    if (here.section.Iy != section.Iy || here.section.Iz != section.Iz ||
        here.section.A != section.A || here.material.young != in.material.young) {
      throw InputError(ErrorCode::unsupported, "analytic shapes need a uniform bar, but " +
                                                   model.element_label(index) +
                                                   " has another section or material");
    }
    L = end.dot(axis);
  }
  const Mat3 T = beam_axes(in);
  const double E = in.material.young;
  const int per_plane = 1 + dynamic_per_plane;
  ModeSet set;
  set.X = MatX::Zero(6 * model.nodes(), 2 * per_plane);
  set.K = MatX::Zero(2 * per_plane, 2 * per_plane);
  set.names.resize(2 * per_plane);
  for (int mode = 0; mode < per_plane; ++mode) {
    const double beta = mode > 0 ? clamped_pinned_root(mode) : 0.0;
    for (int plane = 0; plane < 2; ++plane) {
      const int a = 2 * mode + plane;
      const double EI = E * (plane == 0 ? section.Iz : section.Iy);
      set.K(a, a) = EI * (mode == 0 ? 3.0 : std::pow(beta, 4)) / (L * L * L);
      set.names[a] = (mode == 0 ? std::string("static tip ")
                                : "clamped-pinned " + std::to_string(mode) + " ") +
                     (plane == 0 ? "y" : "z");
      for (int k = 0; k < model.nodes(); ++k) {
        const double s = (model.positions[k] - start).dot(axis) / L;
        const Shape shape = mode == 0 ? static_tip(s) : clamped_pinned(beta, s);
        const double slope = shape.slope / L;
        // rz = v', ry = -w'
        set.X.block<3, 1>(6 * k, a) = shape.value * T.col(1 + plane);
        set.X.block<3, 1>(6 * k + 3, a) =
            plane == 0 ? Vec3(slope * T.col(2)) : Vec3(-slope * T.col(1));
      }
    }
  }
  return set;
}

}  // namespace floatframe
