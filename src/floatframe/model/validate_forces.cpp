// Force elements and roads.
#include "floatframe/model/joint_motion.hpp"
#include "floatframe/model/rules.hpp"
#include "floatframe/model/sentences.hpp"
#include "floatframe/model/validate.hpp"

namespace floatframe::validation {

namespace {

bool is_zero(const PiecewisePolynomial& f) {
  for (const PiecewisePolynomial::Piece& p : f.pieces())
    for (const double c : p.coefficients)
      if (c != 0.0) return false;
  return true;
}

struct ForceCheck {
  const ModelDescription& d;
  const Names& names;
  const Entity& entity;

  void laws(const PiecewisePolynomial& spring, const PiecewisePolynomial& damper,
            const std::optional<SignalDescription>& actuator, bool target = false) const {
    entity.pieces("spring", spring);
    entity.pieces("damper", damper);
    if (actuator) entity.signal("actuator", *actuator, names);
    // Model files may give a law of zeros: the reader knows whether one is there.
    if (entity.origin.mark.file.empty() && !actuator && !target && is_zero(spring) &&
        is_zero(damper))
      entity.fault(sentences::no_law());
  }

  void operator()(const SpringDamperDescription& s) const {
    const bool a = entity.place("from", s.a, names), b = entity.place("to", s.b, names);
    if (a && b && s.a.body == s.b.body) {
      entity.fault(sentences::both_ends_on(s.a.body));
    } else if (a && b && !s.a.node && !s.b.node) {
      if (const auto complaint = sentences::spring_ends(s.a.point, s.b.point))
        entity.fault(*complaint);
    }
    laws(s.spring, s.damper, s.actuator);
  }

  void operator()(const GuidedSpringDescription& s) const {
    const bool a = entity.place("reference", s.reference, names);
    const bool b = entity.place("tip", s.tip, names);
    if (a && b && s.reference.body == s.tip.body) entity.fault(sentences::both_ends_on(s.tip.body));
    entity.direction("axis", s.axis);
    laws(s.spring, s.damper, s.actuator);
  }

  void operator()(const JointSpringDescription& s) const {
    if (entity.reference("joint", "joint", s.joint, names.joints)) {
      const JointType type = d.joints[*names.joints.find(s.joint)].type;
      if (!joint_has_one_coordinate(type))
        entity.fault("joint", "found '" + s.joint + "', expected a " + joints_of_one_coordinate() +
                                  " joint");
    }
    laws(s.spring, s.damper, s.actuator, s.target || s.target_rate);
    const bool law = !is_zero(s.spring) || !is_zero(s.damper);
    const auto target = [&](const char* key, const std::optional<SignalDescription>& signal) {
      if (!signal) return;
      entity.signal(key, *signal, names);
      if (!law) entity.fault(key, sentences::target_without_law());
    };
    target("target", s.target);
    target("target_rate", s.target_rate);
  }

  void operator()(const TyreDescription& t) const {
    entity.place("", t.centre, names, false);
    entity.number("radius", t.radius, rules::tyre_radius);
    entity.number("stiffness", t.stiffness, rules::tyre_stiffness);
    entity.number("damping", t.damping, rules::tyre_damping);
    entity.word("law", t.law, rules::tyre_laws);
    entity.direction("axis", t.axis);
    entity.reference("road", "road", t.road, names.roads);
  }

  void operator()(const AppliedLoadDescription& l) const {
    entity.place("", l.at, names, false);
    entity.direction("direction", l.direction);
    entity.signal("magnitude", l.magnitude, names);
  }
};

}  // namespace

void forces(const ModelDescription& d, const Names& names, Faults& faults) {
  std::set<std::string> taken;
  for (const ForceDescription& f : d.forces) {
    const Entity entity{faults, f.origin, "forces." + f.name};
    name("forces", f.name, taken, entity);
    std::visit(ForceCheck{d, names, entity}, f.kind);
  }
}

void roads(const ModelDescription& d, Faults& faults) {
  std::set<std::string> taken;
  for (const RoadDescription& r : d.roads) {
    const Entity entity{faults, r.origin, "roads." + r.name};
    name("roads", r.name, taken, entity);
    entity.pieces("profile", r.pieces, true);
    for (std::size_t i = 0; i < r.bumps.size(); ++i) {
      const std::string bump = "bumps[" + std::to_string(i + 1) + "].";
      entity.number(bump + "start", r.bumps[i].start, any_number("m"));
      entity.number(bump + "length", r.bumps[i].length, rules::bump_length);
      entity.number(bump + "height", r.bumps[i].height, any_number("m"));
    }
  }
}

}  // namespace floatframe::validation
