#include "floatframe/run/contact_watch.hpp"

#include <fmt/format.h>

#include "floatframe/model/element_kind.hpp"

namespace floatframe {

ContactWatch::ContactWatch(const Model& model, double step) : model_(model), step_(step) {
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& e = model.elements[k];
    if (!element_kind(e.type).contact) continue;
    const ElementDescription described{e.name, *e.keys, {}};
    Watched x;
    x.element = static_cast<int>(k);
    x.kept = e.states;
    x.least_speed = ElementView(described).number("least_speed");
    watched_.push_back(x);
  }
}

void ContactWatch::warn(std::vector<RangeWarning>& out) const {
  const Watched* first = nullptr;
  int others = -1;
  for (const Watched& x : watched_) {
    if (x.first < 0.0) continue;
    ++others;
    if (first == nullptr || x.first < first->first) first = &x;
  }
  if (first == nullptr) return;
  const Element& e = model_.elements[first->element];
  out.push_back(
      {RangeLimit::contact,
       fmt::format("{} '{}'{} touches for fewer than {} steps of {:g} s, from t = {:.4g} s on ({} "
                   "at least), so that its rebound is not that of its restitution; take a step of "
                   "at most {:.2g} s",
                   element_type_name(e.type), e.name,
                   others > 0 ? fmt::format(" (and {} more)", others) : "", enough, step_,
                   first->first, first->fewest,
                   step_ * static_cast<double>(first->fewest - 1) / static_cast<double>(enough))});
}

}  // namespace floatframe
