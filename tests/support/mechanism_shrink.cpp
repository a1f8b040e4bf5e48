// Takes away from a mechanism, one thing at a time, what a violation does not need.
#include <functional>
#include <set>

#include "floatframe/model/element_keys.hpp"
#include "support/mechanism_check.hpp"

namespace floatframe::test {

namespace {

/// Removes what refers to something that is gone.
void tidy(ModelDescription& d) {
  std::set<std::string> bodies{ground_name}, joints, forces;
  for (const BodyDescription& b : d.bodies) bodies.insert(b.name);
  const auto gone = [&](const AttachmentDescription& a) { return !bodies.contains(a.body); };
  std::erase_if(d.joints, [&](const auto& j) { return gone(j.parent) || gone(j.child); });
  for (const JointDescription& j : d.joints) joints.insert(j.name);
  const auto loose = [&](const ElementDescription& f) {
    for (const ElementKey& key : element_keys(f.type())) {
      const auto value = key_value(f, key);
      const auto* at = value ? std::get_if<AttachmentDescription>(&*value) : nullptr;
      if (at && gone(*at)) return true;
    }
    for (const CoordinateTerm& c : ElementView(f).coordinates())
      if (!joints.contains(c.joint)) return true;
    return false;
  };
  std::erase_if(d.rods, loose);
  std::erase_if(d.constraints, loose);
  std::erase_if(d.couplings, loose);
  std::erase_if(d.forces, loose);
  for (const ElementDescription& f : d.forces) forces.insert(f.name);
  std::erase_if(d.outputs, [&](const OutputDescription& o) {
    return gone(o.at) ||
           (!o.entity.empty() && !joints.contains(o.entity) && !forces.contains(o.entity));
  });
  std::erase_if(d.amplitudes, [&](const auto& a) { return !bodies.contains(a.first); });
  std::erase_if(d.amplitude_rates, [&](const auto& a) { return !bodies.contains(a.first); });
}

using Change = std::function<void(ModelDescription&)>;

template <class List>
void removals(std::vector<Change>& out, List ModelDescription::*list, const ModelDescription& d) {
  for (std::size_t k = (d.*list).size(); k-- > 0;)
    out.push_back([list, k](ModelDescription& x) {
      (x.*list).erase((x.*list).begin() + static_cast<std::ptrdiff_t>(k));
    });
}

std::vector<Change> changes(const ModelDescription& d) {
  std::vector<Change> out;
  removals(out, &ModelDescription::forces, d);
  removals(out, &ModelDescription::bodies, d);
  removals(out, &ModelDescription::rods, d);
  removals(out, &ModelDescription::constraints, d);
  removals(out, &ModelDescription::couplings, d);
  removals(out, &ModelDescription::joints, d);
  for (std::size_t k = 0; k < d.joints.size(); ++k) {
    const JointDescription& j = d.joints[k];
    if (j.motion) out.push_back([k](auto& x) { x.joints[k].motion.reset(); });
    if (!j.position.empty()) out.push_back([k](auto& x) { x.joints[k].position.clear(); });
    if (!j.velocity.empty()) out.push_back([k](auto& x) { x.joints[k].velocity.clear(); });
    if (j.cut) out.push_back([k](auto& x) { x.joints[k].cut = false; });
  }
  for (std::size_t k = 0; k < d.bodies.size(); ++k) {
    if (d.bodies[k].rigid || std::holds_alternative<RigidDescription>(d.bodies[k].kind)) continue;
    out.push_back([k](ModelDescription& x) {
      x.bodies[k].rigid = true;
      x.amplitudes.erase(x.bodies[k].name);
      x.amplitude_rates.erase(x.bodies[k].name);
    });
  }
  if (!d.amplitudes.empty()) out.push_back([](auto& x) { x.amplitudes.clear(); });
  if (!d.amplitude_rates.empty()) out.push_back([](auto& x) { x.amplitude_rates.clear(); });
  if (!d.gravity.isZero(0.0)) out.push_back([](auto& x) { x.gravity.setZero(); });
  if (!d.simulation.velocity.isZero(0.0))
    out.push_back([](auto& x) { x.simulation.velocity.setZero(); });
  if (d.simulation.spectral_radius < 1.0)
    out.push_back([](auto& x) { x.simulation.spectral_radius = 1.0; });
  return out;
}

}  // namespace

Mechanism shrunk(const Mechanism& mechanism, Verdict verdict) {
  Mechanism best = mechanism;
  for (bool smaller = true; smaller;) {
    smaller = false;
    for (const Change& change : changes(best.description)) {
      Mechanism trial = best;
      change(trial.description);
      tidy(trial.description);
      if (trial.description.bodies.empty() || judge(trial).verdict != verdict) continue;
      best = std::move(trial);
      smaller = true;
      break;
    }
  }
  return best;
}

}  // namespace floatframe::test
