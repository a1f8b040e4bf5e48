#include "floatframe/decks/nastran/nastran_build.hpp"
#include "floatframe/fe/dependent_dofs.hpp"

namespace floatframe {
namespace {

constexpr unsigned all_six = 63u, translations = 7u;

/// Directions of a node with a rotated system matter unless all three of a kind are used.
bool any_axes(unsigned mask) {
  const unsigned low = mask & 7u, high = mask >> 3;
  return (low == 0u || low == 7u) && (high == 0u || high == 7u);
}

class ConstraintBuilder {
 public:
  explicit ConstraintBuilder(NastranBuild& build) : b_(build) {
    b_.rotates = nodes_with_rotations(b_.model);  // spiders: of bars
  }

  void build() {
    for (const Spider::Kind kind : {Spider::Kind::rigid, Spider::Kind::mean})
      for (const NastranSpider& s : b_.content.spiders)
        if (s.kind == kind) spider(s);
    give_nastran_rigid_rotations(b_);
    for (const NastranMass& m : b_.content.masses) mass(m);
    for (const NastranMass& m : nastran_rigid_masses(b_)) mass(m);
    check_nastran_scalar_masses(b_);
    follow_turned();
    equations();
    build_nastran_rigids(b_);
    for (const NastranSpider* s : general_) build_nastran_mean(b_, *s);
    b_.equations.flush(b_.model, b_.source);
  }

 private:
  /// A node with a turned system that follows only in some of its directions.
  struct Follower {
    const NastranSpider* spider = nullptr;
    int reference = -1, node = -1;
  };

  /// By equations, after the nodes with rotations are known: by an element, a spring, a mass.
  void follow_turned() {
    if (followers_.empty()) return;
    const DofTable dofs = dof_table(b_.model);
    for (const Follower& f : followers_) {
      const bool rotates = dofs.count(f.node) == 6;
      const Mat3 axes = b_.axes(f.node);
      const Vec3 arm = b_.model.positions[f.node] - b_.model.positions[f.reference];
      for (int c = 0; c < (rotates ? 6 : 3); ++c)
        if (((f.spider->mask >> c) & 1u) != 0)
          b_.equations.follow(f.node, c, axes, f.reference, arm, f.spider->at);
    }
  }

  /// An RBE3 whose reference follows in all directions the displacements of its nodes, once each.
  /// Rotations of nodes without rotations do not count. Others give their reference rotations here
  /// and become equations later.
  bool is_plain_mean(const NastranSpider& s) {
    std::set<int> seen;
    bool plain = s.mask == all_six;
    for (std::size_t i = 0; i < s.nodes.size(); ++i) {
      const auto it = b_.node_of.find(s.nodes[i]);
      if (it == b_.node_of.end()) return true;  // an error
      const unsigned mask = s.components[i];
      const bool rotations = (mask >> 3) != 0 && b_.rotates[it->second] != 0;
      plain = plain && seen.insert(it->second).second && (mask & 7u) == translations && !rotations;
    }
    const int reference = b_.node_of.at(s.reference);
    if (!plain && (s.mask >> 3) != 0) b_.give_rotations(reference, s);
    return plain;
  }

  void spider(const NastranSpider& s) {
    const std::string who = s.label();
    if (s.nodes.empty()) return b_.source.error(ErrorCode::missing, s.at, "{} has no nodes", who);
    if (s.mask == 0) return b_.source.error(ErrorCode::missing, s.at, "{} has no components", who);
    const bool rigid = s.kind == Spider::Kind::rigid;
    Spider spider;
    spider.kind = s.kind;
    spider.name = who;
    spider.mask = s.mask;
    spider.source = s.at;
    spider.reference = b_.node(s.reference, s);
    if (spider.reference < 0) return;
    if (!rigid && !is_plain_mean(s)) return general_.push_back(&s);
    for (const int id : s.nodes) {
      const int node = b_.node(id, s);
      if (node < 0) return;
      if (rigid && node == spider.reference)
        return b_.error(ErrorCode::cycle, s, "node {} depends on itself", id);
      if (rigid && (s.mask >> 3) != 0) b_.rotates[node] = 1;
      if (rigid && b_.turned[node] != 0 && !any_axes(s.mask)) {
        followers_.push_back({&s, spider.reference, node});
        continue;
      }
      spider.nodes.push_back(node);
      if (rigid && s.mask == all_six) rigid_of_[node] = static_cast<int>(b_.model.spiders.size());
    }
    if (spider.nodes.empty()) {  // a node that only gives the reference its rotations
      spider.mask = all_six;
      spider.nodes.push_back(b_.add_node(b_.model.positions[spider.reference], s.at, who));
    }
    b_.rotates[spider.reference] = 1;
    if (std::any_of(s.weights.begin(), s.weights.end(), [](double w) { return w != 1.0; }))
      spider.weights = s.weights;
    b_.model.spiders.push_back(std::move(spider));
  }

  void mass(const NastranMass& m) {
    const int node = b_.node(m.node, m);
    if (node < 0) return;
    const Orientation system = m.system > 0 ? b_.frame(m.system, m.at) : Orientation{};
    if (system.kind != Orientation::Kind::rectangular)
      return b_.error(ErrorCode::unsupported, m, "its system {} is not rectangular", m.system);
    PointMass point;
    point.node = node;
    point.source = m.at;
    point.name = m.label();
    point.mass = m.mass * b_.content.mass_factor;
    point.J = b_.content.mass_factor * system.axes * m.J * system.axes.transpose();
    const Vec3 p = b_.model.positions[node];
    // CID -1: the offset is the place of the mass in basic coordinates.
    const Vec3 offset = m.system == -1 ? Vec3(m.offset - p) : Vec3(system.axes * m.offset);
    if (b_.rotates[node] == 0) {
      if (offset.norm() > 0.0)
        return b_.source.error(ErrorCode::unsupported, m.at,
                               "{} has an offset, but node {} has no rotations; tie the mass to "
                               "several nodes (RBE2, RBE3)",
                               point.name, m.node);
      if (point.J.cwiseAbs().maxCoeff() > 0.0) {
        b_.note(m.at,
                fmt::format(
                    "{}: node {} has no rotations, so the inertia has no effect and is left out",
                    point.name, m.node));
        point.J.setZero();
      }
    }
    if (offset.norm() > 0.0) point.node = add_rigid_node(node, p + offset, m);
    b_.model.masses.push_back(point);
  }

  /// A new node that moves rigidly with another.
  int add_rigid_node(int node, const Vec3& p, const NastranMass& m) {
    const int fresh = b_.add_node(p, m.at, m.label());
    const auto spider = rigid_of_.find(node);
    if (spider != rigid_of_.end())
      b_.model.spiders[spider->second].nodes.push_back(fresh);
    else
      add_rigid_spider(b_.model, node, m.label(), m.at).nodes = {fresh};
    return fresh;
  }

  void equations() {
    const bool by_control = b_.content.control.there;
    std::set<int> there;
    for (const NastranEquation& e : b_.content.equations) there.insert(e.id);
    const std::set<int> selected =
        selected_nastran_sets(b_, b_.content.control.mpc, b_.content.added_mpc_sets, there, "MPC");
    int set = 0, applied = 0;
    NastranCount unselected;
    std::vector<const NastranEquation*> of_scalar_points;
    for (const NastranEquation& e : b_.content.equations) {
      if (by_control && !selected.contains(e.id)) {
        unselected.add(e.at);
        continue;
      }
      if (!by_control && set != 0 && e.id != set)
        return b_.source.error(
            ErrorCode::exclusive, e.at,
            "the file has MPC sets {} and {}; only one can be read, remove the other", set, e.id);
      set = e.id;
      ++applied;
      if (std::any_of(e.terms.begin(), e.terms.end(), [&](const NastranEquation::Term& t) {
            return b_.content.scalar_points.contains(t.node);
          })) {
        of_scalar_points.push_back(&e);
        continue;
      }
      LinearEquation equation{{}, e.at};
      for (const NastranEquation::Term& term : e.terms)
        if (add_nastran_term(b_, e, term, equation) < 0) return;
      const int dependent = b_.node_of.at(e.terms[0].node);
      if (b_.turned[dependent] != 0)
        b_.equations.add(dependent, e.terms[0].axis >= 3, equation);
      else
        b_.model.equations.push_back(std::move(equation));
    }
    build_nastran_scalar_equations(b_, of_scalar_points);
    b_.note(
        unselected,
        "MPC equations are in sets that the case control does not select: they are not applied");
    if (by_control && !selected.empty() && applied == 0 && b_.source.errors() == 0)
      b_.source.error(ErrorCode::not_found, b_.content.control.mpc.front().second,
                      "the case control selects MPC set {}, which is not in the file",
                      b_.content.control.mpc.front().first);
  }

  NastranBuild& b_;
  std::unordered_map<int, int> rigid_of_;      // rigid spider that a node follows
  std::vector<const NastranSpider*> general_;  // RBE3 that are equations
  std::vector<Follower> followers_;
};

/// Basic directions within the span of the directions held in rotated axes.
unsigned held_in_basic(const Mat3& axes, unsigned mask) {
  unsigned basic = 0;
  for (int c = 0; c < 6; ++c) {
    double share = 0.0;
    for (int k = 0; k < 3; ++k) {
      const bool held = ((mask >> (c < 3 ? k : 3 + k)) & 1u) != 0;
      if (held) share += axes(c % 3, k) * axes(c % 3, k);
    }
    if (share > 1.0 - 1e-9) basic |= 1u << c;
  }
  return basic;
}

}  // namespace

void build_nastran_constraints(NastranBuild& build) { ConstraintBuilder(build).build(); }

void build_nastran_supports(NastranBuild& build) {
  const NastranNumbers numbers({build.node_of.begin(), build.node_of.end()});
  std::vector<int> nodes;
  for (const NastranSupport& s : build.content.supports) {
    nodes.clear();
    const bool points = build.content.scalar_points.overlaps(s.first, s.last);
    if (s.first == s.last) {
      const int node = points ? -1 : build.node(s.first, s.at, "a support (SPC)");
      if (node >= 0) nodes.push_back(node);
    } else if (!numbers.append(s.first, s.last, nodes) && !points) {
      build.source.error(ErrorCode::not_found, s.at, "SPC1: there is no node from {} to {}",
                         s.first, s.last);
    }
    build.spend(nodes.size(), s.at);
    for (const int node : nodes) {
      const unsigned mask =
          build.turned[node] == 0 ? s.mask : held_in_basic(build.axes(node), s.mask);
      if (mask != 0) build.model.supports.push_back({node, mask, s.at});
    }
  }
}

}  // namespace floatframe
