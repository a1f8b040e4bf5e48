// The functions of FMI 3.0 for co-simulation. Those of model exchange, scheduled execution, events,
// clocks and derivatives, which this FMU does not offer, return an error and say so.
#include "fmi/fmi3_standard.h"
#include "fmi/instance.hpp"

using namespace floatframe::fmi;

namespace {

fmi3Status as_fmi3(Status status) { return fmi3Status(status); }

fmi3Status fmi3_not_offered(fmi3Instance c, const char* function) {
  return as_fmi3(enter(c, Call::never, function, [](Instance&) { return Status::error; }));
}

fmi3Status fmi3_no_values(fmi3Instance c, Call call, const char* function,
                          const fmi3ValueReference references[], size_t count) {
  return as_fmi3(
      enter(c, call, function, [&](Instance& me) { return me.access_none(references, count); }));
}

fmi3Instance refuse(fmi3InstanceEnvironment environment, fmi3LogMessageCallback log,
                    const char* message) {
  if (log != nullptr) log(environment, fmi3Error, category_names[0], message);
  return nullptr;
}

template <class Value, class Found>
void tell(Value* to, Found found) {
  if (to != nullptr) *to = found;
}

}  // namespace

const char* fmi3GetVersion(void) { return "3.0"; }

fmi3Status fmi3SetDebugLogging(fmi3Instance c, fmi3Boolean on, size_t count,
                               const fmi3String categories[]) {
  return as_fmi3(enter(c, Call::set_logging, __func__,
                       [&](Instance& me) { return me.set_logging(on, count, categories); }));
}

fmi3Instance fmi3InstantiateCoSimulation(fmi3String instance, fmi3String token,
                                         fmi3String resources, fmi3Boolean, fmi3Boolean logging,
                                         fmi3Boolean event_mode, fmi3Boolean early_return,
                                         const fmi3ValueReference intermediate[], size_t count,
                                         fmi3InstanceEnvironment environment,
                                         fmi3LogMessageCallback log,
                                         fmi3IntermediateUpdateCallback update) {
  if (event_mode)
    return refuse(
        environment, log,
        "fmi3InstantiateCoSimulation: found the event mode, which this FMU does not offer");
  InstanceOptions options;
  options.version = 3;
  options.name = instance;
  options.token = token;
  options.resources = resources;
  options.logging = logging;
  options.importer = {nullptr, log, environment};
  options.update = update;
  options.early_return = early_return;
  return Instance::make(options, intermediate, count);
}

fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                          fmi3Boolean, fmi3InstanceEnvironment environment,
                                          fmi3LogMessageCallback log) {
  return refuse(environment, log,
                "fmi3InstantiateModelExchange: found model exchange, expected co-simulation");
}

fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, fmi3Boolean,
                                               fmi3Boolean, fmi3InstanceEnvironment environment,
                                               fmi3LogMessageCallback log, fmi3ClockUpdateCallback,
                                               fmi3LockPreemptionCallback,
                                               fmi3UnlockPreemptionCallback) {
  return refuse(
      environment, log,
      "fmi3InstantiateScheduledExecution: found scheduled execution, expected co-simulation");
}

void fmi3FreeInstance(fmi3Instance c) {
  const auto free = [](Instance&) { return Status::ok; };
  if (enter(c, Call::free_instance, __func__, free) == Status::ok) delete static_cast<Instance*>(c);
}

fmi3Status fmi3EnterInitializationMode(fmi3Instance c, fmi3Boolean, fmi3Float64, fmi3Float64 start,
                                       fmi3Boolean has_stop, fmi3Float64 stop) {
  return as_fmi3(enter(c, Call::enter_initialization, __func__, [&](Instance& me) {
    const Status status = me.set_up(start, has_stop, stop);
    if (status != Status::error) me.enter_initialization();
    return status;
  }));
}

fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  return as_fmi3(enter(c, Call::exit_initialization, __func__,
                       [](Instance& me) { return me.exit_initialization(); }));
}

fmi3Status fmi3Terminate(fmi3Instance c) {
  return as_fmi3(enter(c, Call::terminate, __func__, [](Instance& me) { return me.terminate(); }));
}

fmi3Status fmi3Reset(fmi3Instance c) {
  return as_fmi3(enter(c, Call::reset, __func__, [](Instance& me) { return me.reset(); }));
}

fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference references[], size_t count,
                          fmi3Float64 values[], size_t values_count) {
  return as_fmi3(enter(c, Call::get, __func__, [&](Instance& me) {
    if (count != values_count)
      return me.fail("found %zu values, expected %zu: all variables are scalars", values_count,
                     count);
    return me.get(references, count, values);
  }));
}

fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference references[], size_t count,
                          const fmi3Float64 values[], size_t values_count) {
  return as_fmi3(enter(c, Call::set, __func__, [&](Instance& me) {
    if (count != values_count)
      return me.fail("found %zu values, expected %zu: all variables are scalars", values_count,
                     count);
    return me.set(references, count, values);
  }));
}

// Types of which there is no variable.
#define FLOATFRAME_NO_VALUES(Type)                                                              \
  fmi3Status fmi3Get##Type(fmi3Instance c, const fmi3ValueReference references[], size_t count, \
                           fmi3##Type[], size_t) {                                              \
    return fmi3_no_values(c, Call::get, __func__, references, count);                           \
  }                                                                                             \
  fmi3Status fmi3Set##Type(fmi3Instance c, const fmi3ValueReference references[], size_t count, \
                           const fmi3##Type[], size_t) {                                        \
    return fmi3_no_values(c, Call::set, __func__, references, count);                           \
  }
FLOATFRAME_NO_VALUES(Float32)
FLOATFRAME_NO_VALUES(Int8)
FLOATFRAME_NO_VALUES(UInt8)
FLOATFRAME_NO_VALUES(Int16)
FLOATFRAME_NO_VALUES(UInt16)
FLOATFRAME_NO_VALUES(Int32)
FLOATFRAME_NO_VALUES(UInt32)
FLOATFRAME_NO_VALUES(Int64)
FLOATFRAME_NO_VALUES(UInt64)
FLOATFRAME_NO_VALUES(Boolean)
FLOATFRAME_NO_VALUES(String)
#undef FLOATFRAME_NO_VALUES
fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference references[], size_t count,
                         size_t[], fmi3Binary[], size_t) {
  return fmi3_no_values(c, Call::get, __func__, references, count);
}
fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference references[], size_t count,
                         const size_t[], const fmi3Binary[], size_t) {
  return fmi3_no_values(c, Call::set, __func__, references, count);
}

fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state) {
  return as_fmi3(
      enter(c, Call::keep_state, __func__, [&](Instance& me) { return me.get_state(state); }));
}

fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  return as_fmi3(
      enter(c, Call::keep_state, __func__, [&](Instance& me) { return me.set_state(state); }));
}

fmi3Status fmi3FreeFMUState(fmi3Instance c, fmi3FMUState* state) {
  return as_fmi3(
      enter(c, Call::keep_state, __func__, [&](Instance& me) { return me.free_state(state); }));
}

fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state, size_t* size) {
  return as_fmi3(enter(c, Call::keep_state, __func__,
                       [&](Instance& me) { return me.size_of_state(state, size); }));
}

fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, fmi3Byte bytes[],
                                 size_t size) {
  return as_fmi3(enter(c, Call::keep_state, __func__,
                       [&](Instance& me) { return me.write_state(state, bytes, size); }));
}

fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const fmi3Byte bytes[], size_t size,
                                   fmi3FMUState* state) {
  return as_fmi3(enter(c, Call::keep_state, __func__,
                       [&](Instance& me) { return me.read_state(bytes, size, state); }));
}

fmi3Status fmi3DoStep(fmi3Instance c, fmi3Float64 time, fmi3Float64 size, fmi3Boolean,
                      fmi3Boolean* event_handling_needed, fmi3Boolean* terminate,
                      fmi3Boolean* early_return, fmi3Float64* last_successful_time) {
  return as_fmi3(enter(c, Call::step, __func__, [&](Instance& me) {
    StepReport report;
    const Status status = me.do_step(time, size, report);
    tell(event_handling_needed, false);
    tell(terminate, false);
    tell(early_return, report.early);
    tell(last_successful_time, report.time);
    return status;
  }));
}

// What modelDescription.xml does not offer.
#define FLOATFRAME_NOT_OFFERED(name, ...)                      \
  fmi3Status name(fmi3Instance c __VA_OPT__(, ) __VA_ARGS__) { \
    return fmi3_not_offered(c, __func__);                      \
  }
FLOATFRAME_NOT_OFFERED(fmi3EnterEventMode)
FLOATFRAME_NOT_OFFERED(fmi3EnterStepMode)
FLOATFRAME_NOT_OFFERED(fmi3EnterConfigurationMode)
FLOATFRAME_NOT_OFFERED(fmi3ExitConfigurationMode)
FLOATFRAME_NOT_OFFERED(fmi3EnterContinuousTimeMode)
FLOATFRAME_NOT_OFFERED(fmi3EvaluateDiscreteStates)
FLOATFRAME_NOT_OFFERED(fmi3UpdateDiscreteStates, fmi3Boolean*, fmi3Boolean*, fmi3Boolean*,
                       fmi3Boolean*, fmi3Boolean*, fmi3Float64*)
FLOATFRAME_NOT_OFFERED(fmi3GetNumberOfVariableDependencies, fmi3ValueReference, size_t*)
FLOATFRAME_NOT_OFFERED(fmi3GetVariableDependencies, fmi3ValueReference, size_t[],
                       fmi3ValueReference[], size_t[], fmi3DependencyKind[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetDirectionalDerivative, const fmi3ValueReference[], size_t,
                       const fmi3ValueReference[], size_t, const fmi3Float64[], size_t,
                       fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetAdjointDerivative, const fmi3ValueReference[], size_t,
                       const fmi3ValueReference[], size_t, const fmi3Float64[], size_t,
                       fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetOutputDerivatives, const fmi3ValueReference[], size_t,
                       const fmi3Int32[], fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetClock, const fmi3ValueReference[], size_t, fmi3Clock[])
FLOATFRAME_NOT_OFFERED(fmi3SetClock, const fmi3ValueReference[], size_t, const fmi3Clock[])
FLOATFRAME_NOT_OFFERED(fmi3GetIntervalDecimal, const fmi3ValueReference[], size_t, fmi3Float64[],
                       fmi3IntervalQualifier[])
FLOATFRAME_NOT_OFFERED(fmi3GetIntervalFraction, const fmi3ValueReference[], size_t, fmi3UInt64[],
                       fmi3UInt64[], fmi3IntervalQualifier[])
FLOATFRAME_NOT_OFFERED(fmi3GetShiftDecimal, const fmi3ValueReference[], size_t, fmi3Float64[])
FLOATFRAME_NOT_OFFERED(fmi3GetShiftFraction, const fmi3ValueReference[], size_t, fmi3UInt64[],
                       fmi3UInt64[])
FLOATFRAME_NOT_OFFERED(fmi3SetIntervalDecimal, const fmi3ValueReference[], size_t,
                       const fmi3Float64[])
FLOATFRAME_NOT_OFFERED(fmi3SetIntervalFraction, const fmi3ValueReference[], size_t,
                       const fmi3UInt64[], const fmi3UInt64[])
FLOATFRAME_NOT_OFFERED(fmi3SetShiftDecimal, const fmi3ValueReference[], size_t, const fmi3Float64[])
FLOATFRAME_NOT_OFFERED(fmi3SetShiftFraction, const fmi3ValueReference[], size_t, const fmi3UInt64[],
                       const fmi3UInt64[])
FLOATFRAME_NOT_OFFERED(fmi3CompletedIntegratorStep, fmi3Boolean, fmi3Boolean*, fmi3Boolean*)
FLOATFRAME_NOT_OFFERED(fmi3SetTime, fmi3Float64)
FLOATFRAME_NOT_OFFERED(fmi3SetContinuousStates, const fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetContinuousStateDerivatives, fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetEventIndicators, fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetContinuousStates, fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetNominalsOfContinuousStates, fmi3Float64[], size_t)
FLOATFRAME_NOT_OFFERED(fmi3GetNumberOfEventIndicators, size_t*)
FLOATFRAME_NOT_OFFERED(fmi3GetNumberOfContinuousStates, size_t*)
FLOATFRAME_NOT_OFFERED(fmi3ActivateModelPartition, fmi3ValueReference, fmi3Float64)
#undef FLOATFRAME_NOT_OFFERED
