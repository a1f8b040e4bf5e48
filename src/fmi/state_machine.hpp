#pragma once
// The states of a co-simulation FMU and the calls that each of them allows, after the state
// machines of FMI 2.0 and 3.0, for an FMU without event mode, structural parameters and
// asynchronous steps.
//
// A call that returns an error - one that is not allowed, too - ends the run, as both standards
// say: FMI 2 calls the state after it "error", FMI 3 "terminated". Values can still be read, a
// saved state can be set, and a reset begins anew.
#include <array>

namespace floatframe::fmi {

enum class State { instantiated, initialization, stepping, intermediate, terminated, failed };

/// Kinds of calls that the same states allow.
enum class Call {
  set_logging,           ///< fmi2SetDebugLogging
  free_instance,         ///< fmi2FreeInstance
  set_up,                ///< fmi2SetupExperiment
  enter_initialization,  ///< fmi2EnterInitializationMode
  exit_initialization,   ///< fmi2ExitInitializationMode
  terminate,             ///< fmi2Terminate
  reset,                 ///< fmi2Reset
  get,                   ///< fmi2GetReal, ...
  set,                   ///< fmi2SetReal, ...
  keep_state,            ///< fmi2GetFMUstate, fmi2SerializeFMUstate, ...
  step,                  ///< fmi2DoStep
  ask_status,            ///< fmi2GetStatus, ...
  never,                 ///< what this FMU does not offer
};

/// Names for messages.
inline constexpr std::array<const char*, 6> state_names{"instantiated", "initialization mode",
                                                        "step mode",    "intermediate update",
                                                        "terminated",   "error"};

namespace detail {
constexpr unsigned in(State state) { return 1u << unsigned(state); }
inline constexpr unsigned starting = in(State::instantiated) | in(State::initialization);
inline constexpr unsigned over = in(State::terminated) | in(State::failed);
inline constexpr unsigned outside_of_steps = starting | in(State::stepping) | over;

/// By `Call`.
inline constexpr std::array<unsigned, 13> allowed{
    outside_of_steps | in(State::intermediate),  // set_logging
    outside_of_steps,                            // free_instance
    in(State::instantiated),                     // set_up
    in(State::instantiated),                     // enter_initialization
    in(State::initialization),                   // exit_initialization
    in(State::stepping),                         // terminate
    outside_of_steps,                            // reset
    outside_of_steps | in(State::intermediate),  // get; in `instantiated` what has a start value
    starting | in(State::stepping),              // set
    outside_of_steps,                            // keep_state
    in(State::stepping),                         // step
    in(State::stepping) | over,                  // ask_status
    0u,                                          // never
};
}  // namespace detail

constexpr bool is_allowed(Call call, State state) noexcept {
  return (detail::allowed[unsigned(call)] & detail::in(state)) != 0;
}

}  // namespace floatframe::fmi
