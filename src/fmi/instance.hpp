#pragma once
// An instance of a co-simulation FMU: what the functions of FMI 2.0 and 3.0 have in common. A
// simulation of floatframe.h, the state machine, and what belongs to a run: its times, its figures
// and the states that the importer keeps.
//
// Value references are a fixed scheme: 0 the time, 0x10000 + i input i, 0x20000 + i output i,
// 0x30000 + i parameter i, 0x40000 + k figure k of the run.
//
// A step of the importer (`do_step`) is made of inner steps of the model's own size h, as many as
// fit, and one or two shortened ones if something is left. A whole number of inner steps gives the
// bits of `floatframe run`. After initialisation neither steps nor values allocate.
#include <array>
#include <cstdarg>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>
#include <string>
#include <vector>

#include "fmi/functions.hpp"
#include "fmi/log.hpp"
#include "fmi/saved_state.hpp"
#include "fmi/state_machine.hpp"

namespace floatframe::fmi {

struct InstanceOptions {
  int version = 2;                  ///< of FMI: 2 or 3
  const char* name = nullptr;       ///< of the instance
  const char* token = nullptr;      ///< guid or instantiationToken: the fingerprint of the model
  const char* resources = nullptr;  ///< URI or path of the folder `resources`
  bool logging = false;
  Importer importer;
  fmi3IntermediateUpdateCallback update = nullptr;  ///< after each inner step
  bool early_return = false;                        ///< the importer copes with it
};

/// What fmi3DoStep says of a step.
struct StepReport {
  bool early = false;
  double time = 0.0;  ///< reached [s]
};

class Instance {
 public:
  /// NULL: the log says why. `variables` are those that FMI 3 reads in intermediate updates.
  static Instance* make(const InstanceOptions& options, const std::uint32_t* variables = nullptr,
                        std::size_t count = 0) noexcept;
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  /// At the beginning of each call. Other than ok: it is not allowed now.
  Status begin(Call call, const char* function) noexcept;
  /// Says that the call of now has failed; ends the run.
#if defined(__GNUC__) && !defined(_WIN32)  // there it stands for the formats of msvcrt
  __attribute__((format(printf, 2, 3)))
#endif
  Status
  fail(const char* format, ...) noexcept;

  Status set_logging(bool on, std::size_t count, const char* const* categories) noexcept;
  Status set_up(double start, bool has_stop, double stop) noexcept;
  Status enter_initialization() noexcept;
  Status exit_initialization() noexcept;
  Status terminate() noexcept;
  Status reset() noexcept;

  Status get(const std::uint32_t* references, std::size_t count, double* values) noexcept;
  Status set(const std::uint32_t* references, std::size_t count, const double* values);
  /// Of types of which there is no variable.
  Status access_none(const std::uint32_t* references, std::size_t count) noexcept;

  Status do_step(double at, double size, StepReport& report) noexcept;
  /// Of the last inner step that was accepted [s].
  double time() const noexcept;

  Status get_state(void** state);
  Status set_state(void* state);
  Status free_state(void** state);
  Status size_of_state(void* state, std::size_t* size);
  Status write_state(void* state, void* bytes, std::size_t size);
  Status read_state(const void* bytes, std::size_t size, void** state);

 private:
  enum class Kind { none, time, input, output, parameter, figure };
  struct Variable {
    Kind kind = Kind::none;
    std::int32_t index = 0;
  };
  /// Inner steps that are left, and shorter ones after them.
  struct Plan {
    std::int64_t whole = 0, shorter = 0;
    double size = 0.0;  ///< of each of those that are shorter [s]
    bool is_over() const { return whole == 0 && shorter == 0; }
  };

  Instance(const InstanceOptions& options, floatframe_simulation* simulation);
  Variable variable(std::uint32_t reference) const noexcept;
  double value(Variable variable) const noexcept;
  double figure(Figure figure) const noexcept;
  Status set_parameters(const std::uint32_t* references, std::size_t count, const double* values);
  Status set_inputs(const std::uint32_t* references, std::size_t count, const double* values,
                    Status status);
  /// After a call of the simulation, the message of which it says.
  Status worse(Status status, floatframe_status found) noexcept;
  /// The start with the present inputs and parameters, if these have changed since the last one.
  Status ensure_start() noexcept;
  void unstart() noexcept;
  void count_step(double seconds, double size) noexcept;
  Status check_step(double at, double size) noexcept;
  Plan plan(double offset, double size) const noexcept;
  Status advance(Plan plan, double target, StepReport& report) noexcept;
  Status update(Plan& plan, double target, StepReport& report) noexcept;
  Status apply(const SavedState& state);
  SavedState* find_state(void* state) const noexcept;
  State after_error() const noexcept { return version_ == 2 ? State::failed : State::terminated; }

  const floatframe_functions& f_ = functions();
  floatframe_simulation* simulation_;
  int version_;
  Log log_;
  fmi3IntermediateUpdateCallback update_;
  void* environment_;
  bool early_return_;
  std::vector<double> first_inputs_, first_parameters_;
  std::vector<std::int32_t> indices_;  // of the parameters in one call, and their values
  std::vector<double> numbers_;        // or inputs before the call
  std::vector<std::unique_ptr<SavedState>> states_;

  const char* function_ = "";  // the call of now
  State state_ = State::instantiated;
  Run run_;
};

/// The body of an exported function: with an instance, in a state that allows the call, without
/// exceptions. A status of the standards has the numbers of `Status`.
template <class Body>
Status enter(void* instance, Call call, const char* function, Body&& body) noexcept {
  if (instance == nullptr) return Status::error;
  Instance& me = *static_cast<Instance*>(instance);
  try {
    const Status status = me.begin(call, function);
    return status == Status::ok ? body(me) : status;
  } catch (const std::bad_alloc&) {
    return me.fail("no memory is left");
  } catch (...) {
    return me.fail("an internal error");
  }
}

}  // namespace floatframe::fmi
