#include "floatframe/bench/start_models.hpp"

#include <array>
#include <map>

#include "floatframe/bench/chain_model.hpp"
#include "floatframe/core/enum_index.hpp"

namespace floatframe {
namespace {

class Builder {
 public:
  explicit Builder(bool flexible) : flexible_(flexible) {
    d_.simulation.step = 1e-3;
    d_.simulation.duration = 1e-3;
    d_.simulation.spectral_radius = chain_spectral_radius;
  }

  /// A rigid body of 1 kg with its centre of mass at p.
  void block(const std::string& name, const Vec3& p, double inertia = 0.02) {
    BodyDescription b;
    b.name = name;
    b.X_WB.p = b.X_WT.p = p;
    b.kind = RigidDescription{1.0, Vec3::Zero(), inertia * Mat3::Identity()};
    d_.bodies.push_back(b);
  }
  /// A beam from a to b, flexible if the model is.
  void beam(const std::string& name, const Vec3& a, const Vec3& b) {
    if (!flexible_) return block(name, 0.5 * (a + b));
    FlexibleDescription f = std::get<FlexibleDescription>(chain_model(1, 8, 20).bodies[0].kind);
    f.points["start"] = a;
    f.points["end"] = b;
    BodyDescription body;
    body.name = name;
    body.X_WB.p = body.X_WT.p = a;
    body.kind = f;
    ends_[name] = {a, b};
    d_.bodies.push_back(body);
  }
  void joint(JointType type, const std::string& parent, const std::string& child, const Vec3& at,
             const Vec3& axis = Vec3::UnitY()) {
    JointDescription j;
    j.name = "joint_" + std::to_string(d_.joints.size() + 1);
    j.type = type;
    j.axis = axis;
    j.axis_2 = axis.unitOrthogonal();
    j.parent = place(parent, at);
    j.child = place(child, at);
    d_.joints.push_back(j);
  }
  void rod(const std::string& a, const Vec3& at_a, const std::string& b, const Vec3& at_b) {
    d_.rods.push_back({"rod_" + std::to_string(d_.rods.size() + 1),
                       Rod{place(a, at_a), place(b, at_b), {}, {}},
                       {}});
  }
  void spring(const std::string& a, const Vec3& at_a, const std::string& b, const Vec3& at_b) {
    ElementDescription f;
    f.name = "spring_" + std::to_string(d_.forces.size() + 1);
    SpringDamper s;
    s.a = place(a, at_a);
    s.b = place(b, at_b);
    s.spring = PiecewisePolynomial::linear(2e4, (at_b - at_a).norm());
    s.damper = PiecewisePolynomial::linear(1e3, 0.0);
    f.kind = s;
    d_.forces.push_back(f);
  }
  ModelDescription take(std::string name) {
    d_.name = std::move(name);
    return std::move(d_);
  }

 private:
  AttachmentDescription place(const std::string& body, const Vec3& at) const {
    AttachmentDescription p;
    p.body = body;
    p.point = at;
    if (const auto ends = ends_.find(body); ends != ends_.end()) {
      const auto& [start, end] = ends->second;
      p.node = (start - at).norm() < (end - at).norm() ? "start" : "end";
    }
    return p;
  }

  bool flexible_;
  std::map<std::string, std::array<Vec3, 2>> ends_;  ///< of flexible beams
  ModelDescription d_;
};

ModelDescription chain(bool flexible, int links) {
  Builder m(flexible);
  for (int k = 0; k < links; ++k) {
    const std::string name = "link_" + std::to_string(k + 1);
    m.beam(name, Vec3(k, 0, 0), Vec3(k + 1, 0, 0));
    m.joint(JointType::revolute, k == 0 ? std::string(ground_name) : "link_" + std::to_string(k),
            name, Vec3(k, 0, 0));
  }
  return m.take("chain_" + std::to_string(links));
}

/// Posts on the ground, with a rung from the top of each to the top of the next.
ModelDescription ladder(bool flexible, int fields) {
  Builder m(flexible);
  const auto post = [](int k) { return "post_" + std::to_string(k); };
  for (int k = 0; k <= fields; ++k) {
    m.block(post(k), Vec3(k + 0.15, 0, 0.5));
    m.joint(JointType::revolute, std::string(ground_name), post(k), Vec3(k, 0, 0));
  }
  for (int k = 0; k < fields; ++k) {
    const std::string name = "rung_" + std::to_string(k + 1);
    const Vec3 a(k + 0.3, 0, 1), b(k + 1.3, 0, 1);
    m.beam(name, a, b);
    m.joint(JointType::revolute, post(k), name, a);
    m.joint(JointType::revolute, name, post(k + 1), b);
  }
  return m.take("ladder_" + std::to_string(fields));
}

void wheel(Builder& m, const std::string& car, const std::string& chassis, const Vec3& centre,
           double side) {
  const Vec3 in(0, -0.4 * side, 0), low(0, 0, -0.1), high(0, 0, 0.1), back(0.1, 0, 0);
  const auto arm = [&](const char* which, const Vec3& height) {
    const std::string name = car + "_" + which;
    m.beam(name, centre + in + height, centre + height);
    m.joint(JointType::revolute, chassis, name, centre + in + height, Vec3::UnitX());
    return name;
  };
  const std::string lower = arm("lower", low), upper = arm("upper", high);
  const std::string carrier = car + "_carrier", rim = car + "_wheel";
  m.block(carrier, centre);
  m.block(rim, centre, 0.5);
  m.joint(JointType::spherical, lower, carrier, centre + low);
  m.joint(JointType::spherical, upper, carrier, centre + high);
  m.joint(JointType::revolute, carrier, rim, centre);
  m.rod(chassis, centre + in + back, carrier, centre + back);
  m.spring(chassis, centre + in + 5.0 * high, carrier, centre + high);
}

ModelDescription vehicles(bool flexible, int count) {
  Builder m(flexible);
  for (int k = 0; k < count; ++k) {
    const std::string chassis = "chassis_" + std::to_string(k + 1);
    const Vec3 at(0, 3.0 * k, 0.5);
    m.block(chassis, at, 1.0);
    m.joint(JointType::free, std::string(ground_name), chassis, at);
    int w = 0;
    for (const double x : {-1.0, 1.0})
      for (const double side : {-1.0, 1.0})
        wheel(m, "car_" + std::to_string(k + 1) + "_" + std::to_string(++w), chassis,
              at + Vec3(x, 0.7 * side, 0.0), side);
  }
  return m.take("vehicles_" + std::to_string(count));
}

}  // namespace

const char* word(StartKind kind) noexcept {
  static constexpr const char* words[] = {"chain", "ladder", "vehicles"};
  return words[index_of(kind)];
}

ModelDescription start_model(StartKind kind, bool flexible, int count) {
  return kind == StartKind::chain    ? chain(flexible, count)
         : kind == StartKind::ladder ? ladder(flexible, count)
                                     : vehicles(flexible, count);
}

}  // namespace floatframe
