// Bodies of random mechanisms. Stiffness is drawn through the highest frequency of the modes with
// the body frame held: what a step must resolve stays in one range whatever the body looks like.
#include <Eigen/Eigenvalues>
#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/model/build_flexible.hpp"
#include "floatframe/reduction/reduction.hpp"
#include "support/mechanism_builder.hpp"

namespace floatframe::test {

namespace {

constexpr unsigned ux = 1, uy = 2, uz = 4, rx = 8, ry = 16, rz = 32;

/// Highest angular frequency of the modes with the body frame held, zero if it has none. Modes
/// without mass (torsion of a bar without spin inertia) follow at once and have none.
double highest_frequency(const FlexibleBody& f) {
  const MatX M = modal_mass(f.invariants);
  std::vector<Eigen::Index> heavy;
  for (Eigen::Index k = 0; k < M.rows(); ++k)
    if (M(k, k) > 1e-9 * M.diagonal().maxCoeff()) heavy.push_back(k);
  if (heavy.empty()) return 0.0;
  const MatX Mh = M(heavy, heavy), Kh = f.K(heavy, heavy);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatX> e(Kh, Mh, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(0.0, e.eigenvalues().maxCoeff()));
}

NodeDofs dofs(const std::string& node, unsigned mask) {
  NodeDofs n;
  n.node = node;
  n.mask = mask;
  return n;
}

}  // namespace

Vec3 MechanismBuilder::direction() {
  Vec3 v = random.vec3();
  while (v.norm() < 0.2) v = random.vec3();
  return v.normalized();
}

const std::string& MechanismBuilder::name(int body) const {
  static const std::string ground = ground_name;
  return body < 0 ? ground : d.bodies[body].name;
}

int MechanismBuilder::add_known(BodyDescription b, Nodes nodes, double mass) {
  b.name = "body_" + std::to_string(d.bodies.size());
  d.bodies.push_back(std::move(b));
  nodes_.push_back(std::move(nodes));
  masses_.push_back(mass);
  return bodies() - 1;
}

int MechanismBuilder::add_rigid(const Vec3& point) {
  BodyDescription b;
  b.X_WB = {point + random.vec3(0.3), random.rotation()};
  RigidDescription r = random_rigid_body(random);
  const double kind = random(0.0, 1.0);
  if (kind < 0.04) {
    r.mass = 0.0;
    r.J_C.setZero();
  } else if (kind < 0.09) {
    r.J_C.setZero();
  } else if (kind < 0.14) {
    r.J_C = Vec3(0.0, 0.1, 0.1).asDiagonal();
  }
  b.kind = r;
  return add_known(std::move(b), {}, r.mass);
}

/// Modal data that no finite-element model stands behind.
void MechanismBuilder::add_given(BodyDescription& b, Nodes& nodes) {
  FlexibleBody f = random_flexible_body(random, 1 + pick(3), 5);
  if (chance(0.3)) f.D = 0.02 * f.K;
  const bool needs_projection =
      m.relative == InertiaMethod::projection || m.absolute == InertiaMethod::projection;
  if (!needs_projection && chance(0.3)) f.projection = nullptr;
  for (const ModalNode& n : f.nodes) nodes.emplace_back(n.name, b.mirror * n.p);
  b.kind = std::move(f);
}

/// One or two bars along x of the template, or a bent or branched frame; `nodes` in the template.
FlexibleDescription MechanismBuilder::bar_frame(double length, bool straight, Nodes& nodes) {
  FlexibleDescription f;
  f.poisson = 0.3;
  f.density = random(200.0, 600.0);
  f.young = 1e8;
  f.mass_model = mass_models[pick(static_cast<int>(mass_models.size()))];
  f.section_inertia = f.mass_model != MassModel::isoparametric && chance(0.7);
  const double size = length * random(0.08, 0.14);
  SectionDescription section = SolidRound{size};
  const int kind = pick(4);
  if (kind == 1) section = HollowRound{size, 0.6 * size};
  if (kind == 2) section = Rectangle{size, 0.7 * size};
  if (kind == 3) {
    const double a = size * size, i = a * a / 12.0;
    section = SectionConstants{a, i, 1.3 * i, 1.6 * i};
  }
  const auto bar = [&](const char* name, const char* from, const char* to, int elements) {
    BarDescription b;
    b.name = name;
    b.from = from;
    b.to = to;
    b.elements = elements;
    b.section = section;
    b.reference = Vec3(0.3, 1.0, 0.2);
    f.bars.push_back(b);
  };
  const Vec3 a = Vec3::Zero(), c(length, 0, 0);
  const int shape = pick(straight ? 2 : 4);
  Vec3 middle(0.5 * length, 0, 0);
  if (shape == 2) middle += Vec3(0.1 * length, 0.35 * length, 0.1 * length);
  nodes = {{"a", a}, {"c", c}};
  if (shape == 0) {
    bar("bar", "a", "c", 6 + pick(4));
  } else {
    bar("first", "a", "m", 3 + pick(3));
    bar("second", "m", "c", 3 + pick(3));
    nodes.emplace_back("m", middle);
  }
  if (shape == 3) {
    bar("bracket", "", "e", 2);
    f.bars.back().from_bar = "second";
    f.bars.back().from_fraction = 0.0;
    nodes.emplace_back("e", middle + Vec3(0.05, 0.1, 0.3) * length);
  }
  const double choice = random(0.0, 1.0);
  if (shape == 0 && choice < 0.2) {
    f.analytic = AnalyticShapes{pick(3)};
  } else if (shape == 0 && choice < 0.3) {
    const int n = f.bars[0].elements + 1;
    MatX basis = MatX::Zero(6 * n, 2);
    for (int k = 0; k < n; ++k) {
      const double x = static_cast<double>(k) / (n - 1);
      basis(6 * k + 1, 0) = x * x;
      basis(6 * k + 5, 0) = 2.0 * x / length;
      basis(6 * k + 2, 1) = x * x * x;
      basis(6 * k + 4, 1) = -3.0 * x * x / length;
    }
    f.basis = basis;
  } else if (shape < 2 && choice < 0.5) {  // the frame on the chord
    f.clamped = {dofs("a", ux | uy | uz | rx), dofs("c", uy | uz)};
    f.interfaces = {dofs("a", ry | rz)};
    if (chance(0.5)) f.interfaces.push_back(dofs("c", rz));
    f.normal_modes = pick(2);
  } else {
    f.clamped = {dofs("a", all_dofs)};
    f.interfaces = {dofs("c", chance(0.1) ? all_dofs : chance(0.5) ? uy | uz : uz | ry)};
    f.normal_modes = pick(3);
  }
  f.orthonormalise = chance(0.2);
  if (!f.analytic && chance(0.3)) f.masses.push_back({"c", random(0.05, 0.3), {}});
  if (chance(0.3)) f.damping_ratio = 0.02;
  return f;
}

/// Bars with a node at `point` and, if given, another at `to`.
int MechanismBuilder::add_bars(const Vec3& point, const Vec3* to) {
  BodyDescription b;
  Nodes nodes;
  const double length = to ? (*to - point).norm() : random(0.4, 0.8);
  FlexibleDescription f = bar_frame(length, to != nullptr, nodes);
  if (chance(0.2)) {
    b.mirror = Vec3(1, chance(0.5) ? -1 : 1, chance(0.5) ? -1 : 1).asDiagonal();
    b.X_WT = {random.vec3(), random.rotation()};
  }
  Nodes places = nodes;
  for (auto& place : places) place.second = b.mirror * place.second;
  b.X_WB.R = random.rotation();
  if (to) {
    const Vec3 axis = (*to - point) / length;
    b.X_WB.R = Eigen::Quaterniond::FromTwoVectors(Vec3::UnitX(), axis).toRotationMatrix();
    b.X_WB.p = point;
  } else {
    const std::size_t k = pick(static_cast<int>(places.size()));
    b.X_WB.p = point - b.X_WB.R * places[k].second;
  }
  if (b.mirror == Mat3::Identity()) b.X_WT = b.X_WB;
  for (const auto& [node, p] : nodes) f.points[node] = b.X_WT * p;
  for (BarDescription& bar : f.bars) bar.reference = b.X_WT.R * bar.reference;
  b.kind = f;
  ErrorList errors;
  const std::shared_ptr<const FlexibleBody> trial = FlexibleBuilder().build(b, true, errors);
  double mass = 0.5;
  if (trial) {
    const double ratio = random(60.0, 160.0) / std::max(1e-3, highest_frequency(*trial));
    std::get<FlexibleDescription>(b.kind).young *= ratio * ratio;
    mass = trial->invariants.m;
  }
  b.rigid = chance(0.1);
  return add_known(std::move(b), std::move(places), mass);
}

int MechanismBuilder::add_body(const Vec3& point) {
  const double kind = random(0.0, 1.0);
  if (kind < 0.6) return add_rigid(point);
  if (kind < 0.85) return add_bars(point, nullptr);
  BodyDescription b;
  Nodes nodes;
  if (chance(0.2)) b.mirror = Vec3(-1, 1, chance(0.5) ? -1 : 1).asDiagonal();
  add_given(b, nodes);
  b.X_WB.R = random.rotation();
  b.X_WB.p = point - b.X_WB.R * nodes[pick(5)].second;
  b.rigid = chance(0.1);
  const double mass = std::get<FlexibleBody>(b.kind).invariants.m;
  return add_known(std::move(b), std::move(nodes), mass);
}

int MechanismBuilder::add_link(const Vec3& from, const Vec3& to) {
  return chance(0.7) ? add_rigid(0.5 * (from + to)) : add_bars(from, &to);
}

AttachmentDescription MechanismBuilder::somewhere(int body) {
  AttachmentDescription a;
  a.body = name(body);
  if (body < 0) {
    a.point = random.vec3(0.6);
  } else if (is_flexible(body)) {
    const Nodes& nodes = nodes_[body];
    const auto& [node, p] = nodes[pick(static_cast<int>(nodes.size()))];
    a.point = d.bodies[body].X_WB * p;
    if (chance(0.6)) a.node = node;
  } else {
    a.point = d.bodies[body].X_WB * random.vec3(0.3);
  }
  return a;
}

AttachmentDescription MechanismBuilder::at(int body, const Vec3& point) const {
  AttachmentDescription a;
  a.body = name(body);
  a.point = point;
  return a;
}

}  // namespace floatframe::test
