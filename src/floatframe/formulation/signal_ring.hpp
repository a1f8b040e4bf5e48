#pragma once
// Elements that depend on each other in a ring of signals: their states z and the signals s between
// them follow together,
//   w z + z_hat = zdot(ports, z, s),  s = factor force(ports, z, s)                            (1)
// by one Newton iteration with exact slopes; given states are constant. Step time: no heap,
// noexcept.
#include <vector>

#include "floatframe/formulation/element_states.hpp"
#include "floatframe/model/signal_order.hpp"

namespace floatframe {

class SignalRing {
 public:
  /// Allocates.
  SignalRing(const Model& model, const SignalGroup& group);

  /// (1) with `ports_at(k)` of element k, whose links are those of `links`; the efforts there.
  template <class PortsAt>
  void solve(const PortsAt& ports_at, ElementStates& z, std::vector<double>& links,
             std::vector<Efforts>& efforts) noexcept {
    for (const Member& m : members_)
      if (m.states > 0) z.deflect(m.element, ports_at(m.element));
    take(z);
    const bool solved = newton_.solve(
        y_,
        [&] {
          give(z, links);
          for (const Member& m : members_)
            evaluate_element(ports_at(m.element), efforts[m.element]);
          find_gap(z, efforts);
        },
        [&] {
          newton_.slopes.setZero();
          for (Member& m : members_) add_slopes(m, m.finder.find_inner(ports_at(m.element)), z);
          for (const Member& m : members_) hold(m, z);
        });
    if (!solved) z.fail(members_.front().element);
  }

 private:
  struct Result {
    int row;     ///< the unknown that is a link from the element
    int link;    ///< of the model
    int result;  ///< of the element
    double factor;
  };
  struct Member {
    std::size_t element;
    int first, states;         ///< unknowns
    std::vector<int> columns;  ///< unknowns of its inner variables (EffortTangent); -1: given
    std::vector<Result> results;
    TangentFinder finder;
  };
  void take(ElementStates& z) noexcept;
  void give(ElementStates& z, std::vector<double>& links) const noexcept;
  void find_gap(ElementStates& z, const std::vector<Efforts>& efforts) noexcept;
  void add_slopes(const Member& m, const EffortTangent& t, const ElementStates& z) noexcept;
  void hold(const Member& m, ElementStates& z) noexcept;

  std::vector<Member> members_;
  VecX y_;  ///< states of the members, then the links between them
  LocalNewton newton_;
};

}  // namespace floatframe
