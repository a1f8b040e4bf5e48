// CONM1 and CMASS1, 2: matrices of mass of nodes. Those of a rigid body with the mass m, its centre
// at c from the node and J about the node are
//   [ m 1          -m skew(c) ]
//   [ m skew(c)     J         ]
// Others, as a mass in one direction only, have no meaning in a part that moves freely.
#include <fmt/format.h>

#include <cmath>

#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/formats/nastran/nastran_fields.hpp"
#include "floatframe/formats/text/text_fields.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {

void read_nastran_mass_matrix(NastranFields& f, NastranContent& c) {
  NastranMassMatrix m;
  m.card = "CONM1";
  m.at = f.at();
  m.id = f.label(0, "the number of the element");
  m.node = f.label(1, "the node");
  m.system = f.integer(2, "the coordinate system CID", 0);
  std::size_t k = 3;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j) {
      const std::string name = fmt::format("M{}{}", i + 1, j + 1);
      m.M(i, j) = m.M(j, i) = f.real(k++, name.c_str(), 0.0);
    }
  c.mass_matrices.push_back(m);
}

void read_nastran_scalar_mass(NastranFields& f, NastranContent& c) {
  NastranMassMatrix m;
  const bool own = f.name() == "CMASS2";
  m.card = own ? "CMASS2" : "CMASS1";
  m.at = f.at();
  m.id = f.label(0, "the number of the element");
  m.system = -1;  // of the node's displacements
  double mass = 1.0;
  if (own) {
    mass = f.real(1, "M");
  } else {
    m.property = f.blank(1) ? m.id : f.label(1, "the property");
  }
  const auto there = [&](std::size_t i) { return !f.blank(i) && f.text(i) != "0"; };
  const auto point = [&](std::size_t i) { return there(i) && !there(i + 1); };
  const bool both = there(2) && there(4);
  if ((both && point(2) && point(4)) ||
      (!both && (point(2) || point(4)))) {  // an end without component is a scalar point
    NastranScalarMass s{m.card, m.id, m.property, {}, mass, m.at};
    for (std::size_t end = 0; end < 2; ++end)
      if (point(2 + 2 * end)) s.points[end] = f.label(2 + 2 * end, "the node");
    return c.scalar_masses.push_back(s);
  }
  if (both)
    return f.error(ErrorCode::unsupported,
                   "a mass between two nodes is not supported; give CONM2 at each");
  const std::size_t end = there(2) ? 2 : 4;
  m.node = f.label(end, "the node");
  const unsigned mask = f.components(end + 1, "the component");
  int component = 0;
  while (component < 6 && mask != (1u << component)) ++component;
  if (component == 6)
    return f.error(ErrorCode::out_of_range, "the component is {}, expected one of 1 to 6",
                   shown(f.text(end + 1)));
  m.M(component, component) = mass;
  c.mass_matrices.push_back(m);
}

void read_nastran_pmass(NastranFields& f, NastranContent& c) {
  for (std::size_t i = 0; i == 0 || (i < 8 && !f.blank(i)); i += 2) {
    const int id = f.label(i, "the number of the property");
    const auto [it, fresh] = c.pmass.try_emplace(id, std::pair{f.real(i + 1, "M"), f.at()});
    if (!fresh && id > 0) nastran_twice(f, it->second.second);
  }
}

namespace {

/// All of a node, in basic axes.
struct Sum {
  const NastranMassMatrix* first = nullptr;
  Mat6 M = Mat6::Zero();
};

Mat6 in_basic_axes(NastranBuild& build, const NastranMassMatrix& m, int node) {
  const Mat3 R = m.system < 0 ? build.axes(node)
                 : m.system == 0
                     ? Mat3(Mat3::Identity())
                     : nastran_axes_at(build.frame(m.system, m.at), build.model.positions[node]);
  Mat6 T = Mat6::Zero();
  T.topLeftCorner<3, 3>() = T.bottomRightCorner<3, 3>() = R;
  return T * m.M * T.transpose();
}

bool rigid_body(NastranBuild& build, const Sum& sum, NastranMass& out) {
  const NastranMassMatrix& first = *sum.first;
  const Mat3 A = sum.M.topLeftCorner<3, 3>(), B = sum.M.topRightCorner<3, 3>();
  const double m = A.trace() / 3.0, size = std::abs(m) + A.norm();
  const Vec3 moment(0.5 * (B(1, 2) - B(2, 1)), 0.5 * (B(2, 0) - B(0, 2)),
                    0.5 * (B(0, 1) - B(1, 0)));
  if ((A - m * Mat3::Identity()).norm() > 1e-6 * size) {
    build.source.error(ErrorCode::unsupported, first.at,
                       "{} {}: node {} has the masses {:g}, {:g} and {:g} along x, y and z; a part "
                       "that moves freely has one mass in all directions (CONM2)",
                       first.card, first.id, first.node, A(0, 0), A(1, 1), A(2, 2));
    return false;
  }
  if ((B + skew(moment)).norm() > 1e-6 * B.norm() || (m == 0.0 && B.norm() > 0.0) || m < 0.0) {
    build.source.error(ErrorCode::unsupported, first.at,
                       "{} {}: the mass matrix of node {} is not that of a rigid body; give CONM2",
                       first.card, first.id, first.node);
    return false;
  }
  const Vec3 c = m > 0.0 ? Vec3(moment / m) : Vec3(Vec3::Zero());
  out.card = first.card;
  out.id = first.id;
  out.node = first.node;
  out.mass = m;
  out.offset = c;
  const Mat3 S = skew(c);
  out.J = sum.M.bottomRightCorner<3, 3>() + m * S * S;  // about the centre
  if (out.J.norm() < 1e-9 * sum.M.bottomRightCorner<3, 3>().norm()) out.J.setZero();
  out.at = first.at;
  return true;
}

}  // namespace

std::vector<NastranMass> nastran_rigid_masses(NastranBuild& build) {
  std::map<int, Sum> sums;
  const NastranContent& c = build.content;
  for (const NastranMassMatrix& given : c.mass_matrices) {
    NastranMassMatrix m = given;
    const std::string who = fmt::format("{} {}", m.card, m.id);
    const int node = build.node(m.node, m.at, who);
    if (node < 0) continue;
    if (m.property > 0) {
      const auto it = c.pmass.find(m.property);
      if (it == c.pmass.end()) {
        build.source.error(ErrorCode::not_found, m.at, "{}: property {} (PMASS) is not in the file",
                           who, m.property);
        continue;
      }
      m.M *= it->second.first;
    }
    Sum& sum = sums[node];
    if (sum.first == nullptr) sum.first = &given;
    sum.M += in_basic_axes(build, m, node);
  }
  std::vector<NastranMass> out;
  for (const auto& [node, sum] : sums) {
    NastranMass mass;
    if (rigid_body(build, sum, mass)) out.push_back(mass);
  }
  return out;
}

}  // namespace floatframe
