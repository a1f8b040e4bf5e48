// 3-node Timoshenko beam: end, middle, end. Displacements u and rotations theta are quadratic along
// the axis, which may be curved. At xi in [-1, 1]:
//   N = (xi (xi - 1)/2, 1 - xi^2, xi (xi + 1)/2),  ' = d/ds along the arc, t the tangent,
//   local axes R = [t y z], y in the plane of t and the reference
//   strains    R^T (u' - theta x t): stretch, shear along y and z;  R^T theta': twist, curvatures
//   stiffness  int B^T diag(EA, k GA, k GA, GJ, EIy, EIz) B ds with 2 points (no shear locking)
//   mass       rho A int N N^T ds of u; with section inertia also
//              rho int N N^T R diag(Iy + Iz, Iy, Iz) R^T ds of theta; 4 points
// k = 5/6, the shear factor of a rectangle, for every section. Source: Bathe, Finite Element
// Procedures (1996), section 5.4.1, with reduced integration.
#include <cmath>

#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/fe/quadrature.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

constexpr double shear_factor = 5.0 / 6.0;

struct Station {
  Vec3 N, dN;       ///< of the three nodes; derivative along the arc
  Mat3 R;           ///< local axes
  double ds = 0.0;  ///< weight times the length of the arc
  double metric = 0.0;
};

Station station(const ElementInput& in, double x, double weight) {
  Station s;
  s.N << 0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0);
  const Vec3 d(x - 0.5, -2.0 * x, x + 0.5);
  Vec3 tangent = Vec3::Zero();
  for (int a = 0; a < 3; ++a) tangent += d(a) * in.p[a];
  s.metric = tangent.norm();
  s.dN = d / s.metric;
  s.ds = weight * s.metric;
  tangent /= s.metric;
  s.R.col(0) = tangent;
  s.R.col(1) = (in.reference - tangent * tangent.dot(in.reference)).normalized();
  s.R.col(2) = tangent.cross(s.R.col(1));
  return s;
}

template <class Use>
void integrate(const ElementInput& in, int points, Use&& use) {
  const LineRule rule = gauss_jacobi(points, 0);
  for (int q = 0; q < points; ++q) use(station(in, 2.0 * rule.u(q) - 1.0, 2.0 * rule.weight(q)));
}

std::string error(const ElementInput& in) {
  const double length = (in.p[2] - in.p[0]).norm();
  if (!(length > 1e-12 * (in.p[0].norm() + in.p[2].norm()))) return "has zero length";
  if (!(in.reference.norm() > 0.0)) return "has a reference vector of zero length";
  for (const double x : {-1.0, 0.0, 1.0}) {
    const Station s = station(in, x, 1.0);
    // The metric vanishes at an end if the middle node of a straight beam is at a quarter of its
    // length. Nodes from 0.275 to 0.725 of it pass.
    if (!(s.metric > 0.05 * length) || s.R.col(0).dot(in.p[2] - in.p[0]) <= 0.0) {
      return "has a middle node that is not between its ends";
    }
    if (s.R.col(0).cross(in.reference).norm() < 1e-6 * in.reference.norm()) {
      return "has a reference vector parallel to its axis";
    }
  }
  const BeamSection& s = in.section;
  if (!(s.A > 0.0) || !(s.Iy > 0.0) || !(s.Iz > 0.0) || !(s.J > 0.0)) {
    return "has a section whose A, Iy, Iz and J are not all positive";
  }
  return {};
}

void stiffness(const ElementInput& in, MatX& out) {
  const double E = in.material.young, G = in.material.shear();
  const BeamSection& sec = in.section;
  Vec6 c;
  c << E * sec.A, shear_factor * G * sec.A, shear_factor * G * sec.A, G * sec.J, E * sec.Iy,
      E * sec.Iz;
  out = MatX::Zero(18, 18);
  integrate(in, 2, [&](const Station& s) {
    Eigen::Matrix<double, 6, 18> B = Eigen::Matrix<double, 6, 18>::Zero();
    const Mat3 Rt = s.R.transpose();
    for (int a = 0; a < 3; ++a) {
      B.block<3, 3>(0, 6 * a) = s.dN(a) * Rt;
      B.block<3, 3>(0, 6 * a + 3) = s.N(a) * Rt * skew(Vec3(s.R.col(0)));
      B.block<3, 3>(3, 6 * a + 3) = s.dN(a) * Rt;
    }
    out.noalias() += B.transpose() * (s.ds * c).asDiagonal() * B;
  });
  out = (0.5 * (out + out.transpose())).eval();
}

void mass(const ElementInput& in, bool section_inertia, MatX& out) {
  const double rho = in.material.density;
  const BeamSection& sec = in.section;
  const Vec3 turning(sec.Iy + sec.Iz, sec.Iy, sec.Iz);
  out = MatX::Zero(18, 18);
  integrate(in, 4, [&](const Station& s) {
    const Mat3 J = s.R * turning.asDiagonal() * s.R.transpose();
    for (int a = 0; a < 3; ++a) {
      for (int b = 0; b < 3; ++b) {
        const double f = rho * s.ds * s.N(a) * s.N(b);
        out.block<3, 3>(6 * a, 6 * b).diagonal().array() += f * sec.A;
        if (section_inertia) out.block<3, 3>(6 * a + 3, 6 * b + 3) += f * J;
      }
    }
  });
}

void scalar_mass(const ElementInput& in, MatX& out) {
  out = MatX::Zero(3, 3);
  integrate(in, 4, [&](const Station& s) {
    out += (in.material.density * in.section.A * s.ds) * s.N * s.N.transpose();
  });
}

/// At the points of the stiffness: the axial force on slopes and, times (Iy + Iz)/A, on the twist;
/// the torque on the twist of second order -1/2 t . (theta x theta').
void stressed_points(const ElementInput& in, std::vector<StressedPoint>& points) {
  points.clear();
  const BeamSection& sec = in.section;
  integrate(in, 2, [&](const Station& s) {
    const Vec3 t = s.R.col(0);
    const Vec6 along = axial_stress(t);
    const Mat3 across = Mat3::Identity() - t * t.transpose();
    const Mat3 turned = std::sqrt((sec.Iy + sec.Iz) / sec.A) * t * t.transpose();
    StressedPoint tension, twist;
    tension.stress = twist.stress = MatX::Zero(6, 18);
    tension.gradient = twist.gradient = MatX::Zero(9, 18);
    twist.twist = true;
    for (int a = 0; a < 3; ++a) {
      const double force = in.material.young * sec.A * s.dN(a) * s.ds;
      tension.stress.middleCols<3>(6 * a) = force * along * t.transpose();
      for (int i = 0; i < 3; ++i) {
        tension.gradient.block<3, 3>(3 * i, 6 * a) = s.dN(a) * t * across.row(i);
        tension.gradient.block<3, 3>(3 * i, 6 * a + 3) = s.dN(a) * t * turned.row(i);
      }
      const double torque = in.material.shear() * sec.J * s.dN(a) * s.ds;
      twist.stress.block<1, 3>(3, 6 * a + 3) = -0.5 * torque * t.transpose();
      // theta_2 theta_3' - theta_3 theta_2'
      twist.gradient.block<1, 3>(0, 6 * a + 3) = s.N(a) * s.R.col(1).transpose();
      twist.gradient.block<1, 3>(1, 6 * a + 3) = s.dN(a) * s.R.col(2).transpose();
      twist.gradient.block<1, 3>(3, 6 * a + 3) = s.N(a) * s.R.col(2).transpose();
      twist.gradient.block<1, 3>(4, 6 * a + 3) = -s.dN(a) * s.R.col(1).transpose();
    }
    points.push_back(std::move(tension));
    points.push_back(std::move(twist));
  });
}

}  // namespace

constinit const ElementKernel beam3_kernel{.family = ElementFamily::beam,
                                           .nodes = 3,
                                           .dofs_per_node = 6,
                                           .error = &error,
                                           .stiffness = &stiffness,
                                           .mass = &mass,
                                           .scalar_mass = &scalar_mass,
                                           .stressed_points = &stressed_points};

}  // namespace floatframe
