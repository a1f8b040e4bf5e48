#pragma once
// Inputs of a model that are moved by du about their values: what elements give changes by the
// exact derivatives, so that it is linear in du whatever formulas make of it. For an element with
// the efforts E and the results h, signals s to it from others and its own inputs u,
//   ds = factor (h_u du + h_s ds),   E(du) = E + E_u du + E_s ds                               (1)
// at constant motion and states. Load time only: allocates.
#include <vector>

#include "floatframe/model/element_evaluation.hpp"

namespace floatframe {

class InputChanges {
 public:
  explicit InputChanges(const Model& model);
  /// du of each of model.inputs.
  void set(const VecX& du) { du_ = du; }
  /// (1), to the efforts and links at the ports `ports_at(k)` of element k.
  template <class PortsAt>
  void add(const PortsAt& ports_at, std::vector<Efforts>& efforts, std::vector<double>& links) {
    if (du_.isZero(0.0)) return;
    begin();
    for (Member& m : members_) add_equations(m, ports_at(m.element));
    solve();
    for (Member& m : members_) add_efforts(m, ports_at(m.element), efforts[m.element]);
    for (std::size_t l = 0; l < links.size(); ++l) links[l] += ds_[l];
  }

 private:
  struct Member {
    std::size_t element;
    TangentFinder finder;
  };
  void begin();
  void add_equations(Member& m, const Ports& in);
  void solve();
  void add_efforts(Member& m, const Ports& in, Efforts& out);

  const Model& model_;
  std::vector<Member> members_;  ///< elements that inputs or signals enter
  VecX du_, ds_;
  MatX slopes_;  ///< 1 - factor h_s
};

}  // namespace floatframe
