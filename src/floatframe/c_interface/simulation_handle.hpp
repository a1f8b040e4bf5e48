#pragma once
// A handle of the C interface: a model with its options, parameters and inputs, and the simulation
// that was started with them. Its functions throw; those of floatframe.h turn that into a status.
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/c_interface/bounded_text.hpp"
#include "floatframe/c_interface/floatframe.h"
#include "floatframe/c_interface/named_columns.hpp"
#include "floatframe/c_interface/opened_model.hpp"
#include "floatframe/stepping/stepping.hpp"

namespace floatframe {

/// A call that is not possible now.
class WrongOrder : public std::logic_error {
  using std::logic_error::logic_error;
};

/// What the start was found with: a simulation takes more from it than the state that it saves.
struct StartValues {
  std::vector<double> inputs, parameters;
  bool operator==(const StartValues&) const = default;
};

class SimulationHandle {
 public:
  explicit SimulationHandle(OpenedModel opened);
  SimulationHandle(const SimulationHandle&) = delete;
  SimulationHandle& operator=(const SimulationHandle&) = delete;

  floatframe_status set_option(const char* key, const char* value);
  floatframe_status start();
  floatframe_status reset() noexcept;
  floatframe_status step();
  floatframe_status step_by(double size);
  floatframe_status set_input(std::int32_t index, double value);
  floatframe_status set_parameters(std::span<const std::int32_t> indices,
                                   std::span<const double> values);
  floatframe_status save();
  floatframe_status restore(std::span<const std::byte> bytes);

  /// Null before the start.
  const Simulation* started() const noexcept { return simulation_.get(); }
  double step_size() const noexcept {
    return simulation_ ? simulation_->options().step : model_.simulation.step;
  }
  const Model& model() const noexcept { return model_; }
  const std::string& name() const noexcept { return name_; }
  const std::string& fingerprint() const noexcept { return fingerprint_; }
  const NamedColumns& input_columns() const noexcept { return input_columns_; }
  const NamedColumns& output_columns() const noexcept { return output_columns_; }
  const NamedColumns& parameter_columns() const noexcept { return parameter_columns_; }
  const std::vector<double>& initial_inputs() const noexcept { return initial_; }
  const std::vector<double>& inputs() const noexcept { return inputs_; }
  const std::vector<double>& outputs() const noexcept { return outputs_; }
  const std::vector<double>& parameters() const noexcept { return parameters_; }
  const std::vector<std::string>& notes() const noexcept { return notes_; }
  const std::vector<std::byte>& saved() const noexcept { return saved_; }

  BoundedText message;

 private:
  struct Saved;
  Model built(const std::vector<double>& parameters) const;
  static std::vector<std::string> expectations(const Model& model);
  void adopt(Model&& model, std::vector<std::string>&& expected) noexcept;
  void follow_model(std::vector<double>& inputs) const noexcept;
  bool step_with(const std::vector<double>& parameters);
  std::unique_ptr<Simulation> begun(Model& model, const std::vector<double>& inputs) const;
  void take(std::unique_ptr<Simulation> simulation, StartValues from) noexcept;
  floatframe_status end_of_step(const StepReport& report);
  void copy_outputs() noexcept;
  Saved read(std::span<const std::byte> bytes) const;
  void require_start(const char* what) const;

  std::optional<PackedModel> packed_;
  Model model_;
  bool stale_ = false;  ///< `model_` has other parameters than `parameters_`
  std::string name_, fingerprint_;
  std::vector<std::pair<std::string, std::string>> options_;
  NamedColumns input_columns_, output_columns_, parameter_columns_;
  std::vector<std::string> expected_inputs_;  ///< "a number from 0 to 5 [N]"
  std::vector<double> initial_, inputs_, outputs_;
  std::vector<bool> given_;         ///< inputs that were set; others begin as the model says
  std::vector<double> parameters_;  ///< as set
  std::vector<double> running_;     ///< those that the simulation steps with
  StartValues start_;               ///< of the simulation
  std::unique_ptr<Simulation> simulation_;
  std::vector<std::string> notes_;
  bool failed_ = false;  ///< the last step
  BoundedText failure_;
  std::vector<std::byte> saved_;
};

}  // namespace floatframe

struct floatframe_simulation final : floatframe::SimulationHandle {
  using SimulationHandle::SimulationHandle;
};
