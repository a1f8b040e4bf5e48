#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/build_flexible.hpp"
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/model.hpp"

namespace floatframe {

namespace {

std::string point_text(const Vec3& p) {
  std::ostringstream s;
  s << '[' << p.x() << ", " << p.y() << ", " << p.z() << ']';
  return s.str();
}

class Builder {
 public:
  explicit Builder(const ModelDescription& d) : d_(d) {}

  Model build() {
    model_.name = d_.name;
    model_.gravity = d_.gravity;
    model_.simulation = d_.simulation;
    bodies();
    faults_.throw_if_any();
    roads();
    joints();
    rods();
    forces();
    outputs();
    faults_.throw_if_any();
    free_joints();
    finish();
    faults_.throw_if_any();
    return std::move(model_);
  }

 private:
  static constexpr double node_tolerance = 1e-6;

  int body_index(const std::string& name, const SourceMark& mark, const std::string& who) {
    if (name == ground_name) return -1;
    for (std::size_t i = 0; i < model_.bodies.size(); ++i)
      if (model_.bodies[i].name == name) return static_cast<int>(i);
    faults_.add(mark, who + ": found body '" + name + "', expected the name of a body or 'ground'");
    return -2;
  }

  void bodies() {
    std::set<std::string> names{ground_name};
    FlexibleBuilder flexible;
    for (const BodyDescription& b : d_.bodies) {
      Body body;
      body.name = b.name;
      body.X_WB = b.X_WB;
      if (!names.insert(b.name).second)
        faults_.add(b.origin.mark,
                    "bodies." + b.name + ": the name is taken, expected a name used once");
      if (const auto* rigid = std::get_if<RigidDescription>(&b.kind)) {
        check_rigid(b, *rigid);
        FlexibleBody data;
        data.invariants = InertiaInvariants::rigid(rigid->mass, rigid->p_BC, rigid->J_C);
        data.K = data.D = MatX::Zero(0, 0);
        body.data = std::make_shared<const FlexibleBody>(std::move(data));
      } else if (const auto* given = std::get_if<FlexibleBody>(&b.kind)) {
        body.data = std::make_shared<const FlexibleBody>(*given);
      } else {
        body.data = flexible.build(b, faults_);
      }
      if (!body.data) body.data = std::make_shared<const FlexibleBody>();
      model_.bodies.push_back(std::move(body));
    }
    if (d_.bodies.empty()) faults_.add({}, "bodies: found none, expected at least one body");
  }

  void check_rigid(const BodyDescription& b, const RigidDescription& r) {
    const std::string who = "bodies." + b.name;
    if (!(r.mass >= 0.0) || !std::isfinite(r.mass))
      faults_.add(b.origin.of("mass"),
                  who + ".mass: found " + std::to_string(r.mass) + ", expected a number >= 0 [kg]");
    if (!r.J_C.allFinite() || !r.p_BC.allFinite()) {
      faults_.add(b.origin.of("inertia"),
                  who + ".inertia: found a value that is not finite, expected numbers");
      return;
    }
    const Vec3 J = Eigen::SelfAdjointEigenSolver<Mat3>(r.J_C).eigenvalues();
    const double slack = 1e-9 * J.cwiseAbs().maxCoeff();
    if (J[0] < -slack || J[0] + J[1] < J[2] - slack)
      faults_.add(
          b.origin.of("inertia"),
          who + ".inertia: found principal moments " + point_text(J) +
              ", expected positive ones of which none exceeds the sum of the other two [kg m2]");
  }

  /// A marker at a design point; -1 and a fault if the body or node does not exist. `oriented`: the
  /// marker's orientation matters, so the rotation of the node enters.
  int add_marker(const AttachmentDescription& at, const Mat3& R_design, bool oriented,
                 const SourceMark& mark, const std::string& who) {
    const int body = body_index(at.body, mark, who);
    if (body == -2) return -1;
    Marker m;
    m.body = body;
    if (body < 0) {
      m.X_NM = {at.point, R_design};
      model_.markers.push_back(m);
      return static_cast<int>(model_.markers.size()) - 1;
    }
    const Body& b = model_.bodies[static_cast<std::size_t>(body)];
    Pose X_BM = b.X_WB.inverse() * Pose{at.point, R_design};
    const std::vector<ModalNode>& nodes = b.data->nodes;
    if (at.node) {
      for (std::size_t k = 0; k < nodes.size(); ++k)
        if (nodes[k].name == *at.node) m.node = static_cast<int>(k);
      if (m.node < 0) {
        faults_.add(mark, who + ": found node '" + *at.node + "', expected a node of body '" +
                              b.name + "'" + node_names(nodes));
        return -1;
      }
      X_BM.p = nodes[static_cast<std::size_t>(m.node)].p;
    } else if (b.modes() > 0) {
      double best = std::numeric_limits<double>::infinity();
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double distance = (nodes[k].p - X_BM.p).norm();
        if (distance < best) {
          best = distance;
          m.node = static_cast<int>(k);
        }
      }
      if (best > node_tolerance && X_BM.p.norm() <= node_tolerance && frame_is_clamped(nodes)) {
        m.node = -1;  // the body frame itself, which follows fully clamped nodes rigidly
      } else if (best > node_tolerance) {
        const Vec3 nearest = m.node < 0 ? Vec3::Zero().eval()
                                        : Vec3(b.X_WB * nodes[static_cast<std::size_t>(m.node)].p);
        faults_.add(mark, who + ": found point " + point_text(at.point) + " on flexible body '" +
                              b.name + "', expected one of its nodes; the nearest is at " +
                              point_text(nearest));
        return -1;
      }
    }
    if (m.node >= 0) {
      m.X_NM = {X_BM.p - nodes[static_cast<std::size_t>(m.node)].p, X_BM.R};
      if (m.X_NM.p.norm() <= node_tolerance) m.X_NM.p.setZero();
      m.rotates = oriented;
    } else {
      m.X_NM = X_BM;
    }
    for (std::size_t k = 0; k < model_.markers.size();
         ++k)  // joints and forces share equal markers
      if (same(model_.markers[k], m)) return static_cast<int>(k);
    model_.markers.push_back(m);
    return static_cast<int>(model_.markers.size()) - 1;
  }

  /// True if some node keeps its place and orientation in the body frame in every mode.
  static bool frame_is_clamped(const std::vector<ModalNode>& nodes) {
    for (const ModalNode& n : nodes)
      if (n.X.isZero(0.0) && n.X_theta.isZero(0.0)) return true;
    return false;
  }

  static bool same(const Marker& a, const Marker& b) {
    return a.body == b.body && a.node == b.node && a.rotates == b.rotates && a.X_NM.p == b.X_NM.p &&
           a.X_NM.R == b.X_NM.R;
  }

  static std::string node_names(const std::vector<ModalNode>& nodes) {
    std::string text;
    for (const ModalNode& n : nodes)
      if (!n.name.empty()) text += (text.empty() ? " (" : ", ") + n.name;
    return text.empty() ? text : text + ")";
  }

  static Mat3 frame_with_z(const Vec3& axis) {
    Vec3 x, y;
    const Vec3 z = axis.normalized();
    orthonormal_complement(z, x, y);
    Mat3 R;
    R << x, y, z;
    return R;
  }

  void roads() {
    for (const RoadDescription& r : d_.roads) model_.roads.push_back({r.name, r.pieces, r.bumps});
  }

  void joints() {
    std::set<std::string> names;
    for (const JointDescription& j : d_.joints) {
      const std::string who = "joints." + j.name;
      if (!names.insert(j.name).second)
        faults_.add(j.origin.mark, who + ": the name is taken, expected a name used once");
      Joint joint;
      joint.name = j.name;
      joint.type = j.type;
      joint.position = j.position;
      joint.velocity = j.velocity;
      joint.motion = j.motion;
      joint.cut = j.cut;
      joint.parent = body_index(j.parent.body, j.origin.of("parent"), who + ".parent");
      joint.child = body_index(j.child.body, j.origin.of("child"), who + ".child");
      if (joint.parent == -2 || joint.child == -2) continue;
      if (joint.child == -1) {
        faults_.add(j.origin.of("child"),
                    who + ".child: found ground, expected a body (ground may be the parent)");
        continue;
      }
      if (joint.parent == joint.child) {
        faults_.add(j.origin.mark, who + ": found parent and child on the same body '" +
                                       j.child.body + "', expected two bodies");
        continue;
      }
      const bool ball = j.type == JointType::spherical || j.type == JointType::free;
      Mat3 R = ball || j.type == JointType::weld ? Mat3::Identity().eval() : frame_with_z(j.axis);
      if (!ball && j.type != JointType::weld && !(j.axis.norm() > 0.0)) {
        faults_.add(j.origin.of("axis"),
                    who + ".axis: found a vector of length zero, expected a direction");
        R.setIdentity();
      }
      if (j.type == JointType::universal) {
        if (!(j.axis.cross(j.axis_2).norm() > 1e-6 * j.axis.norm() * j.axis_2.norm()))
          faults_.add(j.origin.of("axis_2"),
                      who + ".axis_2: found a direction parallel to axis, expected another");
        else
          joint.axis_2 = R.transpose() * j.axis_2.normalized();
      }
      const auto nv = static_cast<std::size_t>(joint_velocities(j.type));
      for (const auto* list : {&j.position, &j.velocity})
        if (!list->empty() && list->size() != nv)
          faults_.add(j.origin.mark, who + ": found " + std::to_string(list->size()) +
                                         " start values, expected " + std::to_string(nv) +
                                         " for a " + joint_type_name(j.type) + " joint");
      if (j.motion && j.type != JointType::revolute && j.type != JointType::prismatic)
        faults_.add(j.origin.of("motion"), who + ".motion: found on a " + joint_type_name(j.type) +
                                               " joint, expected a revolute or prismatic joint");
      joint.frame_F = add_marker(j.parent, R, !ball, j.origin.of("at"), who);
      joint.frame_M = add_marker(j.child, R, !ball, j.origin.of("at"), who);
      if (joint.frame_F < 0 || joint.frame_M < 0) continue;
      model_.joints.push_back(std::move(joint));
    }
  }

  void rods() {
    for (const RodDescription& r : d_.rods) {
      Rod rod;
      rod.name = r.name;
      rod.a =
          add_marker(r.a, Mat3::Identity(), false, r.origin.of("from"), "rods." + r.name + ".from");
      rod.b = add_marker(r.b, Mat3::Identity(), false, r.origin.of("to"), "rods." + r.name + ".to");
      if (rod.a < 0 || rod.b < 0) continue;
      rod.length = r.length ? *r.length : (design_point(rod.b) - design_point(rod.a)).norm();
      if (!(rod.length > 0.0)) {
        faults_.add(r.origin.mark,
                    "rods." + r.name + ": found length 0, expected a positive length [m]");
        continue;
      }
      if (model_.markers[static_cast<std::size_t>(rod.a)].body ==
          model_.markers[static_cast<std::size_t>(rod.b)].body) {
        faults_.add(r.origin.mark,
                    "rods." + r.name + ": found both ends on one body, expected two bodies");
        continue;
      }
      model_.rods.push_back(rod);
    }
  }

  Vec3 design_point(int marker) const {
    const Marker& m = model_.markers[static_cast<std::size_t>(marker)];
    if (m.body < 0) return m.X_NM.p;
    const Body& b = model_.bodies[static_cast<std::size_t>(m.body)];
    const Vec3 node =
        m.node < 0 ? Vec3::Zero().eval() : b.data->nodes[static_cast<std::size_t>(m.node)].p;
    return b.X_WB * Vec3(node + m.X_NM.p);
  }

  void forces() {
    std::set<std::string> names;
    for (const ForceDescription& f : d_.forces) {
      const std::string who = "forces." + f.name;
      if (!names.insert(f.name).second)
        faults_.add(f.origin.mark, who + ": the name is taken, expected a name used once");
      Force force;
      force.name = f.name;
      bool good = true;
      const Mat3 I = Mat3::Identity();
      if (const auto* s = std::get_if<SpringDamperDescription>(&f.kind)) {
        force.type = ForceType::spring_damper;
        force.a = add_marker(s->a, I, false, f.origin.of("from"), who + ".from");
        force.b = add_marker(s->b, I, false, f.origin.of("to"), who + ".to");
        force.spring = s->spring;
        force.damper = s->damper;
        good = force.a >= 0 && force.b >= 0;
        if (good &&
            model_.markers[static_cast<std::size_t>(force.a)].body ==
                model_.markers[static_cast<std::size_t>(force.b)].body &&
            model_.markers[static_cast<std::size_t>(force.a)].body < 0) {
          faults_.add(f.origin.mark,
                      who + ": found both ends on the ground, expected a body at one end");
          good = false;
        }
      } else if (const auto* g = std::get_if<GuidedSpringDescription>(&f.kind)) {
        force.type = ForceType::guided_spring;
        force.a = add_marker(g->reference, I, true, f.origin.of("reference"), who + ".reference");
        force.b = add_marker(g->tip, I, false, f.origin.of("tip"), who + ".tip");
        force.axis = g->axis.normalized();
        force.spring = g->spring;
        force.damper = g->damper;
        good = force.a >= 0 && force.b >= 0;
      } else if (const auto* js = std::get_if<JointSpringDescription>(&f.kind)) {
        force.type = ForceType::joint_spring;
        force.spring = js->spring;
        force.damper = js->damper;
        good = false;
        for (const Joint& j : model_.joints)
          if (j.name == js->joint) {
            force.a = j.frame_F;
            force.b = j.frame_M;
            force.rotational = j.type == JointType::revolute;
            good = true;
            if (j.type != JointType::revolute && j.type != JointType::prismatic) {
              faults_.add(f.origin.of("joint"), who + ".joint: found a " + joint_type_name(j.type) +
                                                    " joint, expected a revolute or prismatic one");
            }
          }
        if (!good && faults_.empty())
          faults_.add(f.origin.of("joint"),
                      who + ".joint: found '" + js->joint + "', expected the name of a joint");
      } else if (const auto* t = std::get_if<TyreDescription>(&f.kind)) {
        force.type = ForceType::tyre;
        force.b = add_marker(t->centre, I, t->law == TyreLaw::radial, f.origin.of("centre"),
                             who + ".centre");
        force.radius = t->radius;
        force.stiffness = t->stiffness;
        force.damping = t->damping;
        force.law = t->law;
        force.axis = t->axis.normalized();
        for (std::size_t k = 0; k < model_.roads.size(); ++k)
          if (model_.roads[k].name == t->road) force.road = static_cast<int>(k);
        good = force.b >= 0;
        if (force.road < 0) {
          faults_.add(f.origin.of("road"),
                      who + ".road: found '" + t->road + "', expected the name of a road");
          good = false;
        }
      } else if (const auto* l = std::get_if<AppliedLoadDescription>(&f.kind)) {
        force.type = l->torque ? ForceType::torque : ForceType::force;
        force.b = add_marker(l->at, I, l->torque || l->follows, f.origin.of("at"), who + ".at");
        force.axis = l->direction;
        force.magnitude = l->magnitude;
        force.follows = l->follows;
        good = force.b >= 0;
      }
      if (good) model_.forces.push_back(std::move(force));
    }
  }

  void outputs() {
    static const char* const units[] = {"m", "m/s", "m/s2", "rad", "rad/s", "",
                                        "",  "",    "N",    "m",   "m/s"};
    for (const OutputDescription& o : d_.outputs) {
      Output out;
      out.name = o.name;
      out.kind = o.kind;
      out.component = o.component;
      out.unit = units[static_cast<int>(o.kind)];
      const std::string who = "outputs." + o.name;
      switch (o.kind) {
        case OutputKind::position:
        case OutputKind::velocity:
        case OutputKind::acceleration:
          out.marker = add_marker(o.at, Mat3::Identity(), false, o.origin.mark, who);
          if (out.marker < 0) continue;
          break;
        case OutputKind::rotation:
        case OutputKind::angular_velocity:
        case OutputKind::modal_amplitude:
          out.body = body_index(o.at.body, o.origin.mark, who);
          if (out.body < 0) continue;
          if (o.kind == OutputKind::modal_amplitude) {
            const int nm = model_.bodies[static_cast<std::size_t>(out.body)].modes();
            if (o.component < 0 || o.component >= nm) {
              faults_.add(o.origin.mark, who + ": found mode " + std::to_string(o.component + 1) +
                                             ", expected 1 to " + std::to_string(nm));
              continue;
            }
            out.unit = "-";
          }
          break;
        case OutputKind::joint_position:
        case OutputKind::joint_velocity: {
          for (std::size_t k = 0; k < model_.joints.size(); ++k)
            if (model_.joints[k].name == o.entity) out.joint = static_cast<int>(k);
          if (out.joint < 0) {
            faults_.add(o.origin.mark,
                        who + ": found '" + o.entity + "', expected the name of a joint");
            continue;
          }
          const JointType type = model_.joints[static_cast<std::size_t>(out.joint)].type;
          if (o.component < 0 || o.component >= joint_velocities(type)) {
            faults_.add(o.origin.mark, who + ": found coordinate " +
                                           std::to_string(o.component + 1) + ", expected 1 to " +
                                           std::to_string(joint_velocities(type)));
            continue;
          }
          const bool metres = type == JointType::prismatic ||
                              ((type == JointType::cylindrical) && o.component == 0) ||
                              (type == JointType::free && o.component < 3);
          out.unit = metres ? "m" : "rad";
          if (o.kind == OutputKind::joint_velocity) out.unit += "/s";
          break;
        }
        case OutputKind::force:
        case OutputKind::length:
        case OutputKind::rate: {
          for (std::size_t k = 0; k < model_.forces.size(); ++k)
            if (model_.forces[k].name == o.entity) out.force = static_cast<int>(k);
          if (out.force < 0) {
            faults_.add(o.origin.mark,
                        who + ": found '" + o.entity + "', expected the name of a force");
            continue;
          }
          const Force& f = model_.forces[static_cast<std::size_t>(out.force)];
          if (f.rotational || f.type == ForceType::torque)
            out.unit = o.kind == OutputKind::force    ? "N m"
                       : o.kind == OutputKind::length ? "rad"
                                                      : "rad/s";
          break;
        }
      }
      model_.outputs.push_back(std::move(out));
    }
  }

  /// Bodies that no joint leads to from the ground hang from it by a free joint (the first in file
  /// order each time).
  void free_joints() {
    std::vector<char> reached(model_.bodies.size(), 0);
    const auto spread = [&] {
      for (bool more = true; more;) {
        more = false;
        for (const Joint& j : model_.joints) {
          if (j.cut) continue;
          const bool p = j.parent < 0 || reached[static_cast<std::size_t>(j.parent)];
          const bool c = reached[static_cast<std::size_t>(j.child)];
          if (p == c) continue;
          reached[static_cast<std::size_t>(p ? j.child : j.parent)] = 1;
          more = true;
        }
      }
    };
    spread();
    for (std::size_t i = 0; i < reached.size(); ++i) {
      if (reached[i]) continue;
      const Body& b = model_.bodies[i];
      Joint joint;
      joint.name = b.name + ".free";
      joint.type = JointType::free;
      joint.child = static_cast<int>(i);
      joint.automatic = true;
      Marker ground;
      ground.X_NM = {b.X_WB.p, Mat3::Identity()};
      joint.frame_F = static_cast<int>(model_.markers.size());
      model_.markers.push_back(ground);
      Marker own;
      own.body = static_cast<int>(i);
      own.X_NM.R = b.X_WB.R.transpose();
      joint.frame_M = static_cast<int>(model_.markers.size());
      model_.markers.push_back(own);
      model_.joints.push_back(std::move(joint));
      reached[i] = 1;
      spread();
    }
  }

  void finish() {
    double mass = 0.0;
    int heavy = 0;
    for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
      Body& b = model_.bodies[i];
      const InertiaInvariants& v = b.data->invariants;
      if (v.m > 0.0) {
        mass += v.m;
        ++heavy;
      }
      double length = 0.0;
      for (const ModalNode& n : b.data->nodes) length = std::max(length, n.p.norm());
      for (const Marker& m : model_.markers)
        if (m.body == static_cast<int>(i) && m.node < 0) length = std::max(length, m.X_NM.p.norm());
      if (v.m > 0.0) length = std::max(length, std::sqrt(std::max(v.P_u.trace(), 0.0) / v.m));
      b.length = length > 0.0 ? length : 1.0;
      const auto amplitudes = [&](const std::map<std::string, VecX>& given,
                                  std::vector<VecX>& out) {
        const auto it = given.find(b.name);
        out.push_back(it == given.end() ? VecX() : it->second);
        if (it != given.end() && it->second.size() != b.modes())
          faults_.add({}, "initial." + b.name + ": found " + std::to_string(it->second.size()) +
                              " modal amplitudes, expected " + std::to_string(b.modes()));
      };
      amplitudes(d_.amplitudes, model_.amplitudes);
      amplitudes(d_.amplitude_rates, model_.amplitude_rates);
    }
    model_.mean_mass = heavy > 0 ? mass / heavy : 1.0;
    for (const auto& [name, values] : d_.amplitudes) {
      (void)values;
      if (body_index(name, {}, "initial.amplitudes") < -1) continue;
    }
  }

  const ModelDescription& d_;
  Model model_;
  Faults faults_;
};

}  // namespace

const std::string& Model::body_name(int body) const {
  static const std::string ground = ground_name;
  return body < 0 ? ground : bodies[static_cast<std::size_t>(body)].name;
}

Model build_model(const ModelDescription& description) { return Builder(description).build(); }

}  // namespace floatframe
