#pragma once
// A model whose inputs can be varied about their values: external signals, laws of prescribed
// motions, roads that are lifted under each wheel, each with its first and second derivative at the
// present time. It works on a copy of the model, so that the original is not modified, and has
// outputs with reactions that satisfy the equations of motion. In a signal everything but the
// outputs is exactly linear (formulation/input_changes.hpp), so that its step may be large;
// formulas of outputs are differentiated exactly in their parts (output_parts.hpp). Load time only.
#include <optional>
#include <vector>

#include "floatframe/linear/linear_ports.hpp"
#include "floatframe/linear/linear_reduction.hpp"
#include "floatframe/linear/output_parts.hpp"
#include "floatframe/model/output_kind.hpp"
#include "floatframe/reactions/reaction_solver.hpp"
#include "floatframe/start/start_up.hpp"

namespace floatframe {

class ExcitedSystem {
 public:
  /// At the start state that was found, with these outputs only. `started` outlives it.
  ExcitedSystem(InitialisedModel& started, std::vector<Output> outputs, double step);
  ExcitedSystem(const ExcitedSystem&) = delete;
  ExcitedSystem& operator=(const ExcitedSystem&) = delete;

  Formulation& formulation() noexcept { return f_; }
  const State& state() const noexcept { return state_; }
  const std::vector<std::string>& open_outputs() const noexcept;
  /// Coordinates and states of elements.
  Eigen::Index unknowns() const noexcept { return f_.velocities() + state_count(model_); }

  double value(const LinearInput& input) const;
  /// Moves the input by this much from its value, rate and second derivative; zeros reset it.
  void move(const LinearInput& input, const Vec3& by);
  /// Derivatives at constant x, v, a and lambda: `step` as a change of the input.
  void derivatives(const LinearInput& input, double step, Eigen::Index column, InputMotions& out);
  /// For a signal: a step that changes forces by about 1e-4 of the weight of a body or 1e-3 of the
  /// largest force: not too little for digits, nor too much for outputs that are not linear.
  double step_of(const LinearInput& input);
  /// Parts of the outputs at increments x, dv and da of the state; x of all unknowns, the others
  /// may have more rows than coordinates.
  VecX outputs(const VecX& x, const VecX& dv, const VecX& da);
  /// The outputs from their parts at the state, and their derivative with that of the parts along a
  /// unit of an input; null: at constant inputs.
  VecX output_values(const VecX& parts) const;
  VecX output_derivatives(const VecX& parts, const VecX& dparts, const LinearInput* input) const;

 private:
  VecX balance();  ///< residual, Phi and its derivatives

  void change_inputs(const VecX& by);

  OutputParts parts_;
  Model model_;
  std::unique_ptr<Formulation> own_;
  Formulation& f_;  ///< *own_
  State state_;
  const Model& original_;  ///< with the laws of motions that `move` replaces
  std::vector<double> inputs_;
  std::optional<ReactionSolver> reactions_;
  std::vector<FollowedOutput> followed_;
};

}  // namespace floatframe
