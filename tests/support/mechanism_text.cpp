// What a random mechanism holds, in words and numbers.
#include <fmt/format.h>

#include <map>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/element_outputs.hpp"
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
std::string text(const std::vector<std::string>& words) {
  return fmt::format("[{}]", fmt::join(words, ", "));
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
  std::string s = text(f.pieces);
  for (const SineTerm& x : f.sines)
    s += fmt::format(" + {:.6g} sin(2 pi {:.6g} t + {:.6g})", x.amplitude, x.frequency, x.phase);
  if (f.formula) s += " + " + f.formula->text;
  return s;
}
std::string text(const SignalDescription& s) {
  std::string all = text(static_cast<const TimeFunction&>(s));
  if (s.source != SignalSource::none)
    all += fmt::format(" + {:.17g} {} of {}", s.factor, signal_source_words[index_of(s.source)],
                       s.element);
  return all;
}
std::string text(const std::vector<SignalDescription>& signals) {
  std::string all;
  for (const SignalDescription& s : signals) all += (all.empty() ? "" : ", ") + text(s);
  return "[" + all + "]";
}
std::string text(const AttachmentDescription& a) {
  return a.body + (a.node ? " node " + *a.node : "") + " " + text(a.point);
}

std::string text(const CoordinateTerm& t) {
  return fmt::format("{:.17g} {} {}", t.factor, t.joint, t.coordinate);
}
std::string text(const std::vector<CoordinateTerm>& terms) {
  std::string s;
  for (const CoordinateTerm& t : terms) s += (s.empty() ? "" : " + ") + text(t);
  return s;
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

struct ValueText {
  std::string operator()(double x) const { return fmt::format("{:.17g}", x); }
  std::string operator()(int k) const { return std::to_string(k); }
  std::string operator()(bool yes) const { return yes ? "true" : "false"; }
  std::string operator()(const std::string& s) const { return s; }
  std::string operator()(const ForceFunction& f) const { return f.identity(); }
  std::string operator()(const SharedFormula& f) const { return f ? f->text : "none"; }
  std::string operator()(const MatX& m) const {
    return fmt::format("{} x {}: {:.17g}", m.rows(), m.cols(), fmt::join(m.reshaped(), ", "));
  }
  template <class T>
  std::string operator()(const T& x) const {
    return text(x);
  }
};

/// "spring_damper from ..., to ..."
std::string text(const ElementDescription& f) {
  std::string s = element_type_name(f.type());
  for (const ElementKey& key : element_keys(f.type()))
    if (const auto value = key_value(f, key))
      s += std::string(" ") + key.name + " " + std::visit(ValueText(), *value) + ",";
  return s;
}

bool moves(const TimeFunction& f) {
  return !f.sines.empty() || f.pieces.pieces().size() > 1 ||
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
  for (const auto* list : {&d.constraints, &d.couplings})
    for (const ElementDescription& c : *list) ++counts[element_type_name(c.type())];
  for (const ElementDescription& f : d.forces) {
    ++counts[element_type_name(f.type())];
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
  for (const ElementDescription& r : d.rods) s += "  " + r.name + " " + text(r) + '\n';
  for (const auto* list : {&d.constraints, &d.couplings})
    for (const ElementDescription& c : *list) s += "  " + c.name + " " + text(c) + '\n';
  for (const auto* list : {&d.forces, &d.controllers})
    for (const ElementDescription& f : *list) s += "  " + f.name + " " + text(f) + '\n';
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
    if (bars && !bars->damping.none()) return false;
    // The velocity-dependent forces of this mass model are not exact (docs/theory.md, section 7).
    if (bars && bars->mass_model == MassModel::six_dof && !b.rigid) return false;
  }
  for (const JointDescription& j : d.joints)
    if (j.motion) return false;
  for (const ElementDescription& f : d.forces) {
    if (energy_category(f.type()) != EnergyCategory::springs) return false;
    if (element_kind(f.type()).states) return false;
    const ElementView values(f);
    for (const ElementKey& key : element_keys(f.type())) {
      const auto signal = values.signal(key.name);
      if (key.kind == KeyKind::damper && acts(values.law(key.name))) return false;
      if (key.kind == KeyKind::damping_matrix && !values.matrix(key.name).isZero(0.0)) return false;
      if (key.kind == KeyKind::function) return false;
      if (signal && (key.kind != KeyKind::target || moves(*signal))) return false;
    }
  }
  return d.simulation.spectral_radius >= 1.0;
}

}  // namespace floatframe::test
