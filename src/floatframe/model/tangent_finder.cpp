// Exact derivatives of elements: their laws over dual numbers.
#include <algorithm>

#include "floatframe/math/so3.hpp"
#include "floatframe/model/element_kind.hpp"

namespace floatframe {

namespace {

MarkerMotion<Dual> constant(const MarkerState& m) {
  return {m.r.cast<Dual>(), m.R.cast<Dual>(), m.v.cast<Dual>(), m.w.cast<Dual>()};
}

/// With unit derivatives in the directions (dr, dpi, v, w).
MarkerMotion<Dual> moving(const MarkerState& m) {
  MarkerMotion<Dual> out = constant(m);
  for (int c = 0; c < 3; ++c) {
    out.r[c].d[c] = 1.0;
    out.v[c].d[6 + c] = 1.0;
    out.w[c].d[9 + c] = 1.0;
    const Mat3 turned = skew(Vec3::Unit(c)) * m.R;
    for (int k = 0; k < 9; ++k) out.R(k).d[3 + c] = turned(k);
  }
  return out;
}

}  // namespace

TangentFinder::TangentFinder(const Model& model, const Element& element)
    : efforts_(element.markers.size(), element.states, element.further()),
      motions_(element.markers.size()),
      states_(element.states + (element.remembers ? 0 : element.kept)),
      links_(model.links.size()) {
  const Eigen::Index n = 6 * std::ssize(element.markers),
                     results = element.states + 3 + element.further(),
                     inner = element.states + link_count(element);
  out_ = {MatX::Zero(n, n),       MatX::Zero(n, n),       MatX::Zero(n, inner),
          MatX::Zero(results, n), MatX::Zero(results, n), MatX::Zero(results, inner)};
  for (const MarkerMotion<Dual>& m : motions_) markers_.push_back(&m);
  for (const Signal& signal : element.signals)
    if (signal.link >= 0) own_links_.push_back(signal.link);
}

void TangentFinder::evaluate(const Ports& in, const double* input_changes) noexcept {
  efforts_.clear();
  if (!in.element.acts) return;
  element_kind(in.element.type)
      .dual({in.model, in.element, markers_.data(), in.origin, in.t, in.reference_angle, in.inputs,
             in.branch, states_.data(), in.state_weight, links_.data(), in.angles, in.kept,
             input_changes},
            efforts_);
}

const EffortsOf<Dual>& TangentFinder::along_marker(const Ports& in, int marker) noexcept {
  for (int i = 0; i < std::ssize(motions_); ++i)
    motions_[i] = i == marker ? moving(in.marker(i)) : constant(in.marker(i));
  std::copy(in.states, in.states + states_.size(), states_.begin());
  for (const int link : own_links_) links_[link] = in.links[link];
  evaluate(in);
  return efforts_;
}

const EffortsOf<Dual>& TangentFinder::along_inner(const Ports& in, int first) noexcept {
  for (int i = 0; i < std::ssize(motions_); ++i) motions_[i] = constant(in.marker(i));
  const int ns = in.element.states, last = first + dual_directions;
  for (int i = 0; i < std::ssize(states_); ++i) {
    states_[i] = in.states[i];
    if (i >= first && i < std::min(ns, last)) states_[i].d[i - first] = 1.0;
  }
  for (int i = 0; i < std::ssize(own_links_); ++i) {
    Dual& link = links_[own_links_[i]] = in.links[own_links_[i]];
    if (ns + i >= first && ns + i < last) link.d[ns + i - first] = 1.0;
  }
  evaluate(in);
  return efforts_;
}

const EffortsOf<Dual>& TangentFinder::along_signals(const Ports& in, const VecX& inputs,
                                                    const VecX& links) noexcept {
  assert(std::ssize(in.inputs) == inputs.size() && std::ssize(links_) == links.size());
  for (int i = 0; i < std::ssize(motions_); ++i) motions_[i] = constant(in.marker(i));
  std::copy(in.states, in.states + states_.size(), states_.begin());
  for (const int link : own_links_) {
    links_[link] = in.links[link];
    links_[link].d[0] = links[link];
  }
  evaluate(in, inputs.data());
  return efforts_;
}

const Dual::Directions& TangentFinder::wrench(Eigen::Index row) const noexcept {
  const WrenchOf<Dual>& w = efforts_.wrench[row / 6];
  return (row % 6 < 3 ? w.F[row % 6] : w.T[row % 6 - 3]).d;
}

const Dual::Directions& TangentFinder::result(Eigen::Index row) const noexcept {
  const auto states = std::ssize(efforts_.state_rates);
  if (row < states) return efforts_.state_rates[row].d;
  return efforts_.result(row - states).d;
}

const EffortTangent& TangentFinder::find_inner(const Ports& in) noexcept {
  const int inner = out_.slopes.cols();
  for (int first = 0; first < inner; first += dual_directions) {
    along_inner(in, first);
    for (int i = first; i < std::min(inner, first + dual_directions); ++i) {
      for (Eigen::Index row = 0; row < out_.of_inner.rows(); ++row)
        out_.of_inner(row, i) = -wrench(row)[i - first];
      for (Eigen::Index row = 0; row < out_.slopes.rows(); ++row)
        out_.slopes(row, i) = result(row)[i - first];
    }
  }
  return out_;
}

const EffortTangent& TangentFinder::find(const Ports& in) noexcept {
  for (int j = 0; j < std::ssize(motions_); ++j) {
    along_marker(in, j);
    for (Eigen::Index row = 0; row < out_.K.rows(); ++row) {
      out_.K.row(row).segment<6>(6 * j) = -wrench(row).head<6>().matrix().transpose();
      out_.C.row(row).segment<6>(6 * j) = -wrench(row).tail<6>().matrix().transpose();
    }
    for (Eigen::Index row = 0; row < out_.motion.rows(); ++row) {
      out_.motion.row(row).segment<6>(6 * j) = result(row).head<6>().matrix().transpose();
      out_.rates.row(row).segment<6>(6 * j) = result(row).tail<6>().matrix().transpose();
    }
  }
  return find_inner(in);
}

EffortTangent exact_tangent(const Ports& in) {
  return TangentFinder(in.model, in.element).find(in);
}

}  // namespace floatframe
