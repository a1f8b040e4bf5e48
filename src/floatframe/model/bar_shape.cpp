#include "floatframe/model/bar_shape.hpp"

#include <cmath>

namespace floatframe {
namespace {

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

}  // namespace

BodyShape bar_shape(const FrameDescription& frame, const FeModel& model) {
  BodyShape out;
  for (const Element& e : model.elements) {
    BodyShape::Bar bar;
    bar.from = e.nodes[0];
    bar.to = e.nodes[1];
    const Vec3 x = (model.positions[bar.to] - model.positions[bar.from]).normalized();
    bar.y = (e.reference - e.reference.dot(x) * x).normalized();
    // Each bar has its own section, in the order of the bars.
    set_section(frame.bars[static_cast<std::size_t>(e.section)].section, bar);
    out.bars.push_back(bar);
  }
  return out;
}

}  // namespace floatframe
