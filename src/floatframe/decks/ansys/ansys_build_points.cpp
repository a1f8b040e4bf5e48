// Springs, rigid links and regions, point masses.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "floatframe/decks/ansys/ansys_build.hpp"
#include "floatframe/decks/number_sizes.hpp"

namespace floatframe {
namespace {

using F = AnsysFamily;

/// An element with its type and nodes.
struct AnsysItem {
  const AnsysElement& e;
  const AnsysType& type;
  const std::vector<int>& nodes;
};

/// Calls what is given with every element of a family.
template <typename Use>
void each(AnsysBuild& b, F family, Use use) {
  std::vector<int> nodes;
  for (const AnsysElement& e : b.content.elements) {
    const auto [type, library] = b.known(e);
    if (library != nullptr && library->family == family && b.nodes_of(e, nodes))
      use(AnsysItem{e, *type, nodes});
  }
}

/// Sets the directions along the line of its nodes.
bool along_line(AnsysBuild& b, const AnsysElement& e, const AnsysType& type, Spring& s) {
  if (type.keyopt[3] != 0 && type.keyopt[3] != 1)
    return b.shared_error(ErrorCode::unsupported, e,
                          "KEYOPT(3) = {}: springs in a plane are not read", type.keyopt[3]);
  if (s.nodes[1] < 0)
    return b.error(ErrorCode::incomplete, e, "it has one node, and no direction (KEYOPT(2))");
  const Vec3 d = b.model.positions[s.nodes[1]] - b.model.positions[s.nodes[0]];
  if (!(d.norm() > 0.0))
    return b.error(ErrorCode::geometry, e,
                   "its nodes are at one place, and it has no direction (KEYOPT(2))");
  const int first = type.keyopt[3] == 1 ? 3 : 0;
  s.directions[0].segment<3>(first) = -d.normalized();
  s.directions[1].segment<3>(first) = d.normalized();
  return true;
}

/// COMBIN14: KEYOPT(2) = 0 along the line of its nodes (KEYOPT(3) = 1: a torsion spring about it),
/// 1 to 6 a direction of its nodes.
bool add_spring(AnsysBuild& b, const AnsysItem& item, int& dampers) {
  const auto& [e, type, nodes] = item;
  const AnsysReal* real = b.needed_real(e);
  if (real == nullptr) return false;
  if (real->value(1) != 0.0 || real->value(2) != 0.0) ++dampers;
  Spring s;
  s.stiffness = real->value(0);
  if (s.stiffness == 0.0) return true;
  if (s.stiffness < 0.0)
    return b.shared_error(ErrorCode::out_of_range, e,
                          "its stiffness is {:g}, expected none below 0", s.stiffness);
  s.name = b.label(e);
  s.source = e.at;
  if (nodes.empty() || nodes[0] < 0) return b.error(ErrorCode::missing, e, "it has no node");
  s.nodes = {nodes[0], nodes.size() > 1 ? nodes[1] : -1};
  const int direction = type.keyopt[2];
  if (direction < 0 || direction > 6 || type.keyopt[1] != 0)
    return b.shared_error(
        ErrorCode::unsupported, e,
        "KEYOPT(1) = {}, KEYOPT(2) = {}: expected a linear spring of its line or of UX to ROTZ",
        type.keyopt[1], direction);
  if (direction == 0 && !along_line(b, e, type, s)) return false;
  for (int end = 0; end < 2 && direction > 0; ++end)
    if (s.nodes[end] >= 0)
      s.directions[end].segment<3>(direction > 3 ? 3 : 0) =
          (end == 0 ? -1.0 : 1.0) * b.nodal_axes(s.nodes[end]).col((direction - 1) % 3);
  b.model.springs.push_back(std::move(s));
  return true;
}

/// Nodes joined by rigid beams move as one body: a spider of each connected set.
class RigidBodies {
 public:
  explicit RigidBodies(int nodes) : parent_(nodes), links_(nodes, 0) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  void join(int a, int b, const FeSource& at, const std::string& name) {
    ++links_[a];
    ++links_[b];
    first_.try_emplace(a, at, name);
    first_.try_emplace(b, at, name);
    parent_[root(a)] = root(b);
  }
  void add_to(FeModel& model) {
    std::map<int, std::vector<int>> bodies;
    for (const auto& [node, where] : first_) bodies[root(node)].push_back(node);
    for (const auto& [key, nodes] : bodies) {
      // The node that most links share.
      const int reference = *std::max_element(nodes.begin(), nodes.end(),
                                              [&](int a, int b) { return links_[a] < links_[b]; });
      const auto& [at, name] = first_.at(reference);
      Spider& s = add_rigid_spider(model, reference, name, at);
      for (const int n : nodes)
        if (n != reference) s.nodes.push_back(n);
    }
  }

 private:
  int root(int n) {
    while (parent_[n] != n) n = parent_[n] = parent_[parent_[n]];
    return n;
  }
  std::vector<int> parent_, links_;
  std::map<int, std::pair<FeSource, std::string>> first_;
};

/// MASS21: KEYOPT(3) = 0 masses of the three directions, then moments of inertia; 2 a mass.
bool add_point_mass(AnsysBuild& b, const AnsysItem& item) {
  const auto& [e, type, n] = item;
  const AnsysReal* real = b.needed_real(e);
  if (real == nullptr) return false;
  if (n.empty() || n[0] < 0) return b.error(ErrorCode::missing, e, "it has no node");
  if (type.keyopt[1] != 0 || (type.keyopt[3] != 0 && type.keyopt[3] != 2))
    return b.error(
        ErrorCode::unsupported, e,
        "KEYOPT(1) = {}, KEYOPT(3) = {}: expected masses (0) of a node in space (0 or 2)",
        type.keyopt[1], type.keyopt[3]);
  PointMass m;
  m.node = n[0];
  m.mass = real->value(0);
  const std::size_t inertias = type.keyopt[3] == 0 ? 6 : 1;
  for (std::size_t k = 0; k < inertias; ++k) {
    if (!(real->value(k) < 0.0)) continue;
    if (b.said_once.insert(fmt::format("mass of real constants {}", e.real)).second)
      b.source.error(ErrorCode::out_of_range, real->at,
                     "real constants {}: a {} of {:g} for {}, expected none below 0", e.real,
                     k < 3 ? "mass" : "moment of inertia", real->value(k), b.label(e));
    return false;
  }
  if (type.keyopt[3] == 0) {
    for (std::size_t k = 7; k < 10; ++k)
      if (real->value(k) != 0.0)
        return b.error_once(ErrorCode::unsupported, real->at,
                            "real constants {}: a mass away from its node (constant {} is {:g}) is "
                            "not read; give it a node of its own",
                            e.real, k + 1, real->value(k));
    for (std::size_t k = 1; k < 3; ++k)
      if (std::abs(real->value(k) - m.mass) > 1e-9 * std::abs(m.mass))
        return b.error_once(ErrorCode::unsupported, real->at,
                            "real constants {}: masses of {:g}, {:g} and {:g} in the three "
                            "directions; a part has one",
                            e.real, m.mass, real->value(1), real->value(2));
    m.J.diagonal() << real->value(3), real->value(4), real->value(5);
    if (type.keyopt[2] == 1) {
      const Mat3 R = b.nodal_axes(n[0]);
      m.J = R * m.J * R.transpose();
    }
  }
  return add_ansys_mass(b, e, m);
}

/// KEYOPT(1) of MPC184: 0 a rigid link, of which only the length is kept, 1 a rigid beam.
bool add_rigid(AnsysBuild& b, const AnsysItem& item, RigidBodies& bodies) {
  const auto& [e, type, n] = item;
  if (type.keyopt[1] > 1)
    return b.shared_error(ErrorCode::unsupported, e,
                          "KEYOPT(1) = {}: joints are not read, they are joints of the model; "
                          "rigid links (0) and beams (1) are",
                          type.keyopt[1]);
  if (n.size() < 2 || n[0] < 0 || n[1] < 0 || n[0] == n[1])
    return b.error(ErrorCode::missing, e, "it has no two different nodes");
  if (type.keyopt[1] == 1) {
    bodies.join(n[0], n[1], e.at, b.label(e));
    return true;
  }
  const Vec3 d = b.model.positions[n[1]] - b.model.positions[n[0]];
  if (!(d.norm() > 0.0)) return b.error(ErrorCode::geometry, e, "its nodes are at one place");
  LinearEquation equation{{}, e.at};
  for (int k = 0; k < 3; ++k)
    if (const double x = d(k) / d.norm(); std::abs(x) > 1e-12) {
      equation.terms.push_back({n[1], k, x});
      equation.terms.push_back({n[0], k, -x});
    }
  b.model.equations.push_back(std::move(equation));
  return true;
}

/// MATRIX27, those of mass or all others.
void build_matrices(AnsysBuild& b, bool of_mass) {
  each(b, F::matrix, [&](const AnsysItem& i) {
    if ((i.type.keyopt[3] == 2) == of_mass) build_ansys_matrix(b, i.e, i.type, i.nodes);
  });
}

}  // namespace

void build_ansys_springs(AnsysBuild& b) {
  int dampers = 0;
  each(b, F::spring, [&](const AnsysItem& i) { add_spring(b, i, dampers); });
  if (dampers > 0)
    b.file_note("the damping of {} COMBIN14 is ignored, the part has modal damping (--damping)",
                dampers);
  build_matrices(b, false);
}

void build_ansys_rigid(AnsysBuild& b) {
  RigidBodies bodies(b.model.nodes());
  each(b, F::rigid, [&](const AnsysItem& i) { add_rigid(b, i, bodies); });
  bodies.add_to(b.model);
  std::map<std::pair<int, unsigned>, std::size_t> regions;
  for (const AnsysRigid& r : b.content.rigid) {
    const int master = b.node(r.master, r.at, "CERIG"), slave = b.node(r.slave, r.at, "CERIG");
    if (master < 0 || slave < 0) continue;
    const auto [it, fresh] = regions.try_emplace({master, r.mask}, b.model.spiders.size());
    if (fresh)
      add_rigid_spider(b.model, master, fmt::format("CERIG of node {}", r.master), r.at).mask =
          r.mask;
    b.model.spiders[it->second].nodes.push_back(slave);
  }
}

bool add_ansys_mass(AnsysBuild& b, const AnsysElement& e, PointMass m) {
  if (m.mass == 0.0 && m.J.isZero(0.0)) return true;
  if (const std::string huge = huge_mass(m.mass, m.J); !huge.empty())
    return b.error(ErrorCode::not_finite, e, "{}", huge);
  if (!m.J.isZero(0.0) && b.rotates[m.node] == 0) {
    b.note(e.at, "{}: node {} has no rotations, so the inertia has no effect and is left out",
           b.label(e), b.model.node_ids[m.node]);
    m.J.setZero();
  }
  m.source = e.at;
  m.name = b.label(e);
  b.model.masses.push_back(std::move(m));
  return true;
}

void build_ansys_masses(AnsysBuild& b) {
  b.rotates = nodes_with_rotations(b.model);
  each(b, F::mass, [&](const AnsysItem& i) { add_point_mass(b, i); });
  build_matrices(b, true);
}

}  // namespace floatframe
