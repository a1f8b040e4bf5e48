#include "floatframe/model/build_flexible.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "floatframe/body/body_shape.hpp"
#include "floatframe/body/mirrored.hpp"
#include "floatframe/fe/bar_frame.hpp"
#include "floatframe/model/build_stages.hpp"
#include "floatframe/reduction/reduction.hpp"

namespace floatframe {

BeamSection bar_section(const SectionDescription& s) {
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

namespace {

/// Collects the bytes of everything that determines a reduction. Every structure is decomposed by a
/// structured binding: after a new member this does not compile until it is in the key.
class Key {
 public:
  void add(double x) {
    x += 0.0;  // -0 and 0 are the same number
    char bytes[sizeof x];
    std::memcpy(bytes, &x, sizeof x);
    text_.append(bytes, sizeof x);
  }
  void add(int n) { add(static_cast<double>(n)); }
  void add(unsigned n) { add(static_cast<double>(n)); }
  void add(bool b) { add(b ? 1.0 : 0.0); }
  void add(MassModel m) { add(static_cast<int>(m)); }
  void add(const std::string& s) {
    add(static_cast<double>(s.size()));
    text_ += s;
  }
  void add(const MatX& m) {
    add(static_cast<double>(m.rows()));
    add(static_cast<double>(m.cols()));
    for (Eigen::Index i = 0; i < m.size(); ++i) add(m.data()[i]);
  }
  void add(const Vec3& v) {
    for (int i = 0; i < 3; ++i) add(v[i]);
  }
  template <class T>
  void add(const std::optional<T>& x) {
    add(x.has_value());
    if (x) add(*x);
  }
  template <class T>
  void add(const std::vector<T>& list) {
    add(static_cast<double>(list.size()));
    for (const T& x : list) add(x);
  }
  template <class A, class B>
  void add(const std::pair<A, B>& x) {
    all(x.first, x.second);
  }
  template <class... T>
  void all(const T&... x) {
    (add(x), ...);
  }

  void add(const NodeDofs& d) {
    const auto& [node, mask, index, origin] = d;
    all(node, mask, index);
  }
  void add(const AnalyticShapes& a) {
    const auto& [dynamic_per_plane] = a;
    add(dynamic_per_plane);
  }
  void add(const DampingBand& band) {
    const auto& [below, fraction] = band;
    all(below, fraction);
  }
  void add(const ModalDamping& d) {
    const auto& [fractions, bands, alpha, beta, reference, interface_frequency] = d;
    all(fractions, bands, alpha, beta, static_cast<int>(reference), interface_frequency);
  }
  void add(const ReductionOptions& options) {
    const auto& [clamped, interfaces, path, normal_modes, max_frequency, analytic, basis,
                 orthonormalise, mass_model, eigen_mass, section_inertia, damping] = options;
    all(clamped, interfaces, path, normal_modes, max_frequency, analytic, basis, orthonormalise,
        mass_model, eigen_mass, section_inertia, damping);
  }
  void add(const Material& m) {
    const auto& [young, poisson, density, elasticity, plane] = m;
    all(young, poisson, density, static_cast<double>(plane));
    add(static_cast<double>(elasticity.has_value()));
    for (Eigen::Index k = 0; elasticity && k < elasticity->size(); ++k) add(elasticity->data()[k]);
  }
  void add(const BeamSection& s) {
    const auto& [A, Iy, Iz, J, outline, width, height, bore, shear_y, shear_z, slenderness] = s;
    all(A, Iy, Iz, J, static_cast<double>(outline), width, height, bore, shear_y, shear_z,
        slenderness);
  }
  void add(const Bar& b) {
    const auto& [name, from, to, from_bar, from_fraction, elements, section, reference] = b;
    all(name, from, to, from_bar, from_fraction, elements, section, reference);
  }
  /// Equal bodies at different positions differ by round-off of their coordinates: points are
  /// rounded to about a billionth of the size, a power of two.
  void add(const BarFrame& frame) {
    const auto& [points, bars, material, masses] = frame;
    double size = 0.0;
    for (const auto& [name, p] : points) size = std::max(size, (p - points.front().second).norm());
    const double digit = size > 0.0 ? std::exp2(std::round(std::log2(size)) - 30.0) : 1e-9;
    add(digit);
    add(static_cast<double>(points.size()));
    for (const auto& [name, p] : points) all(name, Vec3((p / digit).array().round().matrix()));
    all(bars, material, masses);
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// The frame in axes of the body.
BarFrame frame_of(const FrameDescription& f, const Pose& X_TW) {
  BarFrame frame;
  frame.material = {f.young, f.poisson, f.density};
  for (const auto& [name, p] : f.points) frame.points.emplace_back(name, X_TW * p);
  for (const BarDescription& b : f.bars) {
    Bar bar;
    bar.name = b.name;
    bar.from = b.from;
    bar.to = b.to;
    if (b.from_bar) bar.from_bar = *b.from_bar;
    bar.from_fraction = b.from_fraction;
    bar.elements = b.elements;
    bar.section = bar_section(b.section);
    bar.reference = X_TW.R * b.reference;
    frame.bars.push_back(bar);
  }
  for (const NodeMass& m : f.masses) frame.masses.emplace_back(m.node, m.mass);
  return frame;
}

void set_section(const SectionDescription& section, BodyShape::Bar& bar) {
  if (const auto* r = std::get_if<SolidRound>(&section)) {
    bar.round = true;
    bar.width = bar.height = r->diameter;
  } else if (const auto* h = std::get_if<HollowRound>(&section)) {
    bar.round = true;
    bar.width = bar.height = h->outer;
    bar.inner = h->inner / h->outer;
  } else if (const auto* q = std::get_if<Rectangle>(&section)) {
    bar.width = q->width;
    bar.height = q->height;
  } else {
    // The rectangle with the same radii of gyration: b^2 / 12 = Iz / A, h^2 / 12 = Iy / A.
    const auto& c = std::get<SectionConstants>(section);
    bar.width = std::sqrt(12.0 * c.Iz / c.A);
    bar.height = std::sqrt(12.0 * c.Iy / c.A);
  }
}

/// The shape of a frame of bars: its sections between the nodes of its body. `model`: its finite
/// elements, whose nodes are those of the body.
BodyShape bar_shape(const FrameDescription& frame, const FeModel& model) {
  BodyShape out;
  for (const FeElement& e : model.elements) {
    BodyShape::Bar bar;
    bar.from = e.nodes[0];
    bar.to = e.nodes[1];
    const Vec3 x = (model.positions[bar.to] - model.positions[bar.from]).normalized();
    bar.y = (e.reference - e.reference.dot(x) * x).normalized();
    // Each bar has its own section, in the order of the bars.
    set_section(frame.bars[e.section].section, bar);
    out.bars.push_back(bar);
  }
  return out;
}

/// The options with the nodes of the bars of a path in the place of their names.
ReductionOptions with_nodes_of_path(ReductionOptions options, const FrameDescription& frame,
                                    const FeModel& model) {
  std::map<int, unsigned> masks;
  for (const NodeDofs& d : options.path)
    for (const FeElement& e : model.elements)
      if (frame.bars[e.section].name == d.node)
        for (int k = 0; k < 2; ++k) masks[e.nodes[k]] |= d.mask;
  options.path.clear();
  for (const auto& [node, mask] : masks) options.path.push_back({"", mask, node, {}});
  return options;
}

}  // namespace

FeModel bar_model(const BodyDescription& body) {
  return build_bar_frame(frame_of(std::get<FlexibleDescription>(body.kind), body.X_WT.inverse()));
}

std::shared_ptr<const FlexibleBody> FlexibleBuilder::build(const BodyDescription& body,
                                                           bool stiffens, ErrorList& errors) {
  const auto& f = std::get<FlexibleDescription>(body.kind);
  const BarFrame frame = frame_of(f, body.X_WT.inverse());
  const ReductionOptions& options = f;
  Key key;
  key.all(frame, options, stiffens);
  std::shared_ptr<const FlexibleBody> plain;
  for (const Known& k : known_)
    if (k.key == key.text()) plain = k.body;
  if (!plain) {
    try {
      const FeModel model = build_bar_frame(frame);
      FlexibleBody reduced =
          reduce(model, with_nodes_of_path(options, f, model),
                 stiffens ? SecondOrderOf::all_nodes : SecondOrderOf::named_nodes);
      reduced.shape = std::make_shared<const BodyShape>(bar_shape(f, model));
      plain = std::make_shared<const FlexibleBody>(std::move(reduced));
    } catch (const InputError& error) {
      for (const ErrorEntry& entry : error.errors())
        errors.add(entry.code, entry.mark.file.empty() ? body.origin.of("flexible") : entry.mark,
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

Model build_model(const ModelDescription& description) {
  FlexibleBuilder flexible;
  return build_model(description, flexible);
}

Model build_model(const ModelDescription& description, FlexibleBuilder& flexible) {
  return build_model(
      description,
      [&](const BodyDescription& body, bool stiffens, ErrorList& errors) {
        return flexible.build(body, stiffens, errors);
      },
      model_hints);
}

}  // namespace floatframe
