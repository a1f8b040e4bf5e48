#include "floatframe/model/build_flexible.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "floatframe/body/mirrored.hpp"
#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe {

namespace {

BeamSection section_of(const SectionDescription& s) {
  if (const auto* r = std::get_if<SolidRound>(&s)) return BeamSection::solid_round(r->diameter);
  if (const auto* h = std::get_if<HollowRound>(&s))
    return BeamSection::hollow_round(h->outer, h->inner);
  if (const auto* q = std::get_if<Rectangle>(&s))
    return BeamSection::rectangle(q->width, q->height);
  const auto& c = std::get<SectionConstants>(s);
  BeamSection b;
  b.A = c.A;
  b.Iy = c.Iy;
  b.Iz = c.Iz;
  b.J = c.J;
  return b;
}

std::vector<DofSelection> selection(const std::vector<NodeDofs>& dofs) {
  std::vector<DofSelection> out;
  for (const NodeDofs& d : dofs) out.push_back({d.node, -1, d.mask});
  return out;
}

/// Collects the bytes of everything that decides a reduction.
class Key {
 public:
  void add(double x) {
    x += 0.0;  // -0 and 0 are the same number
    char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    text_.append(bytes, sizeof x);
  }
  void add(const std::string& s) { text_ += s + '\0'; }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  void add(const std::vector<NodeDofs>& dofs) {
    add(static_cast<double>(dofs.size()));
    for (const NodeDofs& d : dofs) {
      add(d.node);
      add(static_cast<double>(d.mask));
    }
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The frame in axes of the body; `key` takes all that decides its stiffness and mass.
BarFrame frame_of(const FlexibleDescription& f, const Pose& X_TW, Key& key) {
  BarFrame frame;
  frame.material = {f.young, f.poisson, f.density};
  // About a billionth of the size, a power of two.
  double size = 0.0;
  for (const auto& [name, p] : f.points)
    size = std::max(size, (p - f.points.begin()->second).norm());
  const double digit = size > 0.0 ? std::exp2(std::round(std::log2(size)) - 30.0) : 1e-9;
  key.add(digit);
  for (const auto& [name, p] : f.points) {
    frame.points.emplace_back(name, X_TW * p);
    key.add(name);
    // Equal bodies at other places differ by round-off of their coordinates.
    key.add(Vec3((frame.points.back().second / digit).array().round().matrix()));
  }
  for (double x : {f.young, f.poisson, f.density}) key.add(x);
  for (const BarDescription& b : f.bars) {
    Bar bar;
    bar.name = b.name;
    bar.from = b.from;
    bar.to = b.to;
    if (b.from_bar) bar.from_bar = *b.from_bar;
    bar.from_fraction = b.from_fraction;
    bar.elements = b.elements;
    bar.section = section_of(b.section);
    bar.reference = X_TW.R * b.reference;
    frame.bars.push_back(bar);
    for (const std::string& s : {bar.name, bar.from, bar.to, bar.from_bar}) key.add(s);
    for (double x : {bar.from_fraction, static_cast<double>(bar.elements), bar.section.A,
                     bar.section.Iy, bar.section.Iz, bar.section.J})
      key.add(x);
    key.add(bar.reference);
  }
  for (const NodeMass& m : f.masses) {
    frame.masses.emplace_back(m.node, m.mass);
    key.add(m.node);
    key.add(m.mass);
  }
  return frame;
}

/// The same for how the frame is reduced.
ReductionOptions reduction_of(const FlexibleDescription& f, Key& key) {
  ReductionOptions options;
  options.clamped = selection(f.clamped);
  options.interfaces = selection(f.interfaces);
  options.normal_modes = f.normal_modes;
  options.max_frequency = f.max_frequency;
  if (f.analytic) options.analytic_dynamic_per_plane = f.analytic->dynamic_per_plane;
  options.basis = f.basis;
  options.orthonormalise = f.orthonormalise;
  options.mass_model = f.mass_model;
  options.section_inertia = f.section_inertia;
  options.damping_ratio = f.damping_ratio;
  key.add(f.clamped);
  key.add(f.interfaces);
  for (double x :
       {static_cast<double>(f.normal_modes), f.max_frequency,
        f.analytic ? static_cast<double>(f.analytic->dynamic_per_plane) : -1.0,
        static_cast<double>(f.orthonormalise), static_cast<double>(static_cast<int>(f.mass_model)),
        static_cast<double>(f.section_inertia), f.damping_ratio})
    key.add(x);
  if (f.basis)
    for (Eigen::Index i = 0; i < f.basis->size(); ++i) key.add(f.basis->data()[i]);
  return options;
}

}  // namespace

std::shared_ptr<const FlexibleBody> FlexibleBuilder::build(const BodyDescription& body,
                                                           ErrorList& errors) {
  const auto& f = std::get<FlexibleDescription>(body.kind);
  Key key;
  const BarFrame frame = frame_of(f, body.X_WT.inverse(), key);
  const ReductionOptions options = reduction_of(f, key);
  std::shared_ptr<const FlexibleBody> plain;
  for (const Known& k : known_)
    if (k.key == key.text()) plain = k.body;
  if (!plain) {
    try {
      plain = std::make_shared<const FlexibleBody>(reduce(build_bar_frame(frame), options));
    } catch (const InputError& error) {
      for (const ErrorEntry& entry : error.errors())
        errors.add(entry.mark.file.empty() ? body.origin.of("flexible") : entry.mark,
                   "bodies." + body.name + ": " + entry.message, entry.count);
      return nullptr;
    }
    known_.push_back({key.text(), plain});
  }
  if (body.mirror == Mat3::Identity()) return plain;
  Key mirror_key;
  mirror_key.add(key.text());
  mirror_key.add(Vec3(body.mirror.diagonal()));
  for (const Known& k : known_)
    if (k.key == mirror_key.text()) return k.body;
  auto image = std::make_shared<const FlexibleBody>(mirrored(*plain, body.mirror));
  known_.push_back({mirror_key.text(), image});
  return image;
}

}  // namespace floatframe
