// What a random mechanism holds, in words and numbers.
#include <fmt/format.h>

#include <map>

#include "floatframe/model/joint_motion.hpp"
#include "support/random_mechanism.hpp"

namespace floatframe::test {

namespace {

std::string text(const Vec3& v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x(), v.y(), v.z());
}
std::string text(const std::vector<double>& values) {
  return fmt::format("[{:.17g}]", fmt::join(values, ", "));
}
std::string text(const PiecewisePolynomial& p) {
  std::string s;
  for (std::size_t k = 0; k < p.pieces().size(); ++k)
    s += fmt::format("{}{} about {:.6g}{}", k == 0 ? "" : " | ", text(p.pieces()[k].coefficients),
                     p.pieces()[k].centre,
                     k < p.breaks().size() ? fmt::format(" below {:.6g}", p.breaks()[k]) : "");
  return s;
}
std::string text(const TimeFunction& f) {
  return fmt::format("{} + {:.6g} sin(2 pi {:.6g} t + {:.6g})", text(f.pieces), f.amplitude,
                     f.frequency, f.phase);
}
std::string text(const AttachmentDescription& a) {
  return a.body + (a.node ? " node " + *a.node : "") + " " + text(a.point);
}

std::string kind_of(const BodyDescription& b) {
  if (const auto* r = std::get_if<RigidDescription>(&b.kind))
    return r->mass == 0.0        ? "massless"
           : r->J_C.isZero(0.0)  ? "point mass"
           : r->J_C(0, 0) == 0.0 ? "no spin inertia"
                                 : "rigid";
  const std::string held = b.rigid ? " held rigid" : "";
  const std::string image = b.mirror == Mat3::Identity() ? "" : " mirrored";
  if (const auto* f = std::get_if<FlexibleBody>(&b.kind))
    return fmt::format("given {} modes{}{}", f->modes(), image, held);
  const auto& f = std::get<FlexibleDescription>(b.kind);
  static const char* const masses[] = {"isoparametric", "six_dof", "hermite"};
  return fmt::format("bars {} {}{}{}", masses[static_cast<int>(f.mass_model)],
                     f.analytic ? "analytic"
                     : f.basis  ? "basis"
                                : "Craig-Bampton",
                     image, held);
}

struct ForceText {
  std::string operator()(const SpringDamperDescription& f) const {
    return "spring_damper " + text(f.a) + " to " + text(f.b) + ", spring " + text(f.spring) +
           ", damper " + text(f.damper) + (f.actuator ? ", actuator " + text(*f.actuator) : "");
  }
  std::string operator()(const GuidedSpringDescription& f) const {
    return "guided_spring " + text(f.reference) + " to " + text(f.tip) + " along " + text(f.axis) +
           ", spring " + text(f.spring) + ", damper " + text(f.damper) +
           (f.actuator ? ", actuator " + text(*f.actuator) : "");
  }
  std::string operator()(const JointSpringDescription& f) const {
    return "joint_spring " + f.joint + ", spring " + text(f.spring) + ", damper " + text(f.damper) +
           (f.actuator ? ", actuator " + text(*f.actuator) : "") +
           (f.target ? ", target " + text(*f.target) : "") +
           (f.target_rate ? ", target_rate " + text(*f.target_rate) : "");
  }
  std::string operator()(const TyreDescription& f) const {
    return fmt::format("tyre {} {} R {:.6g} k {:.6g} c {:.6g} axis {} {}",
                       f.law == TyreLaw::radial ? "radial" : "vertical", text(f.centre), f.radius,
                       f.stiffness, f.damping, text(f.axis), f.road);
  }
  std::string operator()(const AppliedLoadDescription& f) const {
    return fmt::format("{}{} {} direction {} magnitude {}", f.torque ? "torque" : "force",
                       f.follows ? " following" : "", text(f.at), text(f.direction),
                       text(f.magnitude));
  }
};

bool moves(const TimeFunction& f) {
  return f.amplitude != 0.0 || f.pieces.pieces().size() > 1 ||
         f.pieces.pieces()[0].coefficients.size() > 1;
}
bool acts(const PiecewisePolynomial& law) {
  return law.pieces().size() > 1 || law(0.3).f != 0.0 || law(0.3).df != 0.0;
}

}  // namespace

std::string summary_of(const ModelDescription& d) {
  std::map<std::string, int> counts;
  for (const BodyDescription& b : d.bodies) ++counts[kind_of(b)];
  for (const JointDescription& j : d.joints)
    ++counts[std::string(joint_type_name(j.type)) + (j.cut ? " cut" : "") +
             (j.motion ? " driven" : "")];
  if (!d.rods.empty()) counts["rod"] = static_cast<int>(d.rods.size());
  for (const ForceDescription& f : d.forces) {
    const std::string s = std::visit(ForceText(), f.kind);
    ++counts[s.substr(0, s.find(' '))];
  }
  std::string s;
  for (const auto& [what, count] : counts)
    s += fmt::format("{}{} {}", s.empty() ? "" : ", ", count, what);
  return s;
}

std::string text_of(const ModelDescription& d) {
  const SimulationDescription& o = d.simulation;
  std::string s = fmt::format("{}: gravity {}, spectral radius {:.6g}, velocity {}{}\n", d.name,
                              text(d.gravity), o.spectral_radius, text(o.velocity),
                              o.start == Start::equilibrium ? ", from equilibrium" : "");
  for (const BodyDescription& b : d.bodies) {
    const Eigen::AngleAxisd turn(b.X_WB.R);
    s += fmt::format("  {} {} at {} turned {}", b.name, kind_of(b), text(b.X_WB.p),
                     text(Vec3(turn.angle() * turn.axis())));
    if (const auto* r = std::get_if<RigidDescription>(&b.kind))
      s += fmt::format(" m {:.17g} centre {} J {} {}", r->mass, text(r->p_BC),
                       text(Vec3(r->J_C.diagonal())),
                       text(Vec3(r->J_C(0, 1), r->J_C(0, 2), r->J_C(1, 2))));
    s += '\n';
  }
  for (const JointDescription& j : d.joints)
    s += fmt::format("  {} {}{} {} to {} axis {} {} position {} velocity {}{}\n", j.name,
                     joint_type_name(j.type), j.cut ? " cut" : "", text(j.parent), text(j.child),
                     text(j.axis), text(j.axis_2), text(j.position), text(j.velocity),
                     j.motion ? " motion " + text(*j.motion) : "");
  for (const RodDescription& r : d.rods)
    s += fmt::format("  {} {} to {}\n", r.name, text(r.a), text(r.b));
  for (const ForceDescription& f : d.forces)
    s += "  " + f.name + " " + std::visit(ForceText(), f.kind) + '\n';
  for (const RoadDescription& r : d.roads) {
    s += "  " + r.name + " " + text(r.pieces);
    for (const CosineBump& b : r.bumps)
      s += fmt::format(" bump {:.6g} {:.6g} {:.6g}", b.start, b.length, b.height);
    s += '\n';
  }
  for (const auto& [name, y] : d.amplitudes)
    s += fmt::format("  {} starts with {:.17g}\n", name, fmt::join(y.begin(), y.end(), ", "));
  for (const auto& [name, y] : d.amplitude_rates)
    s += fmt::format("  {} starts at rates {:.17g}\n", name, fmt::join(y.begin(), y.end(), ", "));
  return s;
}

bool is_conservative(const ModelDescription& d) {
  for (const BodyDescription& b : d.bodies) {
    const auto* given = std::get_if<FlexibleBody>(&b.kind);
    const auto* bars = std::get_if<FlexibleDescription>(&b.kind);
    if (given && !given->D.isZero(0.0)) return false;
    if (bars && bars->damping_ratio > 0.0) return false;
    // The velocity-dependent forces of this mass model are not exact (docs/theory.md, section 7).
    if (bars && bars->mass_model == MassModel::six_dof && !b.rigid) return false;
  }
  for (const JointDescription& j : d.joints)
    if (j.motion) return false;
  struct {
    bool operator()(const SpringDamperDescription& f) const {
      return !f.actuator && !acts(f.damper);
    }
    bool operator()(const GuidedSpringDescription& f) const {
      return !f.actuator && !acts(f.damper);
    }
    bool operator()(const JointSpringDescription& f) const {
      return !f.actuator && !acts(f.damper) && !f.target_rate && !(f.target && moves(*f.target));
    }
    bool operator()(const TyreDescription&) const { return false; }
    bool operator()(const AppliedLoadDescription&) const { return false; }
  } const keeps;
  for (const ForceDescription& f : d.forces)
    if (!std::visit(keeps, f.kind)) return false;
  return d.simulation.spectral_radius >= 1.0;
}

}  // namespace floatframe::test
