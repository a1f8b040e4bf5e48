// The functions of FMI 2.0 for co-simulation, and those of model exchange, which this FMU does not
// offer: they return an error and say so.
//
// Memory of an instance comes from the heap of the process, not from the importer's allocateMemory:
// the standard has that for targets without a heap, and the simulation inside takes its memory
// where Floatframe always does. All of it is taken before the first step.
#include "fmi/fmi2_standard.h"
#include "fmi/instance.hpp"

using namespace floatframe::fmi;

namespace {

fmi2Status as_fmi2(Status status) { return fmi2Status(status); }

fmi2Status fmi2_not_offered(fmi2Component c, const char* function) {
  return as_fmi2(enter(c, Call::never, function, [](Instance&) { return Status::error; }));
}

fmi2Status fmi2_no_values(fmi2Component c, Call call, const char* function,
                          const fmi2ValueReference references[], size_t count) {
  return as_fmi2(
      enter(c, call, function, [&](Instance& me) { return me.access_none(references, count); }));
}

/// What is asked of the last step: `known` answers, all else is of steps that go on alone.
template <class Value>
fmi2Status answer(fmi2Component c, const char* function, bool is_known, Value* value,
                  Value (*known)(const Instance&)) {
  return as_fmi2(enter(c, Call::ask_status, function, [&](Instance& me) {
    if (value == nullptr) return me.fail("found NULL, expected where the answer is to be written");
    if (!is_known) return Status::discard;
    *value = known(me);
    return Status::ok;
  }));
}

}  // namespace

const char* fmi2GetTypesPlatform(void) { return "default"; }
const char* fmi2GetVersion(void) { return "2.0"; }

fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, size_t count,
                               const fmi2String categories[]) {
  return as_fmi2(enter(c, Call::set_logging, __func__, [&](Instance& me) {
    return me.set_logging(on != fmi2False, count, categories);
  }));
}

fmi2Component fmi2Instantiate(fmi2String instance, fmi2Type type, fmi2String guid,
                              fmi2String resources, const fmi2CallbackFunctions* importer,
                              fmi2Boolean, fmi2Boolean logging) {
  if (importer == nullptr) return nullptr;
  InstanceOptions options;
  options.name = instance;
  options.token = guid;
  options.resources = resources;
  options.logging = logging != fmi2False;
  options.importer = {importer->logger, nullptr, importer->componentEnvironment};
  if (type == fmi2CoSimulation) return Instance::make(options);
  if (importer->logger != nullptr)
    importer->logger(importer->componentEnvironment, instance, fmi2Error, category_names[0],
                     "fmi2Instantiate: found model exchange, expected co-simulation");
  return nullptr;
}

void fmi2FreeInstance(fmi2Component c) {
  const auto free = [](Instance&) { return Status::ok; };
  if (enter(c, Call::free_instance, __func__, free) == Status::ok) delete static_cast<Instance*>(c);
}

fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start,
                               fmi2Boolean has_stop, fmi2Real stop) {
  return as_fmi2(enter(c, Call::set_up, __func__, [&](Instance& me) {
    return me.set_up(start, has_stop != fmi2False, stop);
  }));
}

fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return as_fmi2(enter(c, Call::enter_initialization, __func__,
                       [](Instance& me) { return me.enter_initialization(); }));
}

fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return as_fmi2(enter(c, Call::exit_initialization, __func__,
                       [](Instance& me) { return me.exit_initialization(); }));
}

fmi2Status fmi2Terminate(fmi2Component c) {
  return as_fmi2(enter(c, Call::terminate, __func__, [](Instance& me) { return me.terminate(); }));
}

fmi2Status fmi2Reset(fmi2Component c) {
  return as_fmi2(enter(c, Call::reset, __func__, [](Instance& me) { return me.reset(); }));
}

fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference references[], size_t count,
                       fmi2Real values[]) {
  return as_fmi2(enter(c, Call::get, __func__,
                       [&](Instance& me) { return me.get(references, count, values); }));
}

fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference references[], size_t count,
                       const fmi2Real values[]) {
  return as_fmi2(enter(c, Call::set, __func__,
                       [&](Instance& me) { return me.set(references, count, values); }));
}

fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference references[], size_t count,
                          fmi2Integer[]) {
  return fmi2_no_values(c, Call::get, __func__, references, count);
}
fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference references[], size_t count,
                          fmi2Boolean[]) {
  return fmi2_no_values(c, Call::get, __func__, references, count);
}
fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference references[], size_t count,
                         fmi2String[]) {
  return fmi2_no_values(c, Call::get, __func__, references, count);
}
fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference references[], size_t count,
                          const fmi2Integer[]) {
  return fmi2_no_values(c, Call::set, __func__, references, count);
}
fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference references[], size_t count,
                          const fmi2Boolean[]) {
  return fmi2_no_values(c, Call::set, __func__, references, count);
}
fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference references[], size_t count,
                         const fmi2String[]) {
  return fmi2_no_values(c, Call::set, __func__, references, count);
}

fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return as_fmi2(
      enter(c, Call::keep_state, __func__, [&](Instance& me) { return me.get_state(state); }));
}

fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return as_fmi2(
      enter(c, Call::keep_state, __func__, [&](Instance& me) { return me.set_state(state); }));
}

fmi2Status fmi2FreeFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return as_fmi2(
      enter(c, Call::keep_state, __func__, [&](Instance& me) { return me.free_state(state); }));
}

fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state, size_t* size) {
  return as_fmi2(enter(c, Call::keep_state, __func__,
                       [&](Instance& me) { return me.size_of_state(state, size); }));
}

fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte bytes[],
                                 size_t size) {
  return as_fmi2(enter(c, Call::keep_state, __func__,
                       [&](Instance& me) { return me.write_state(state, bytes, size); }));
}

fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte bytes[], size_t size,
                                   fmi2FMUstate* state) {
  return as_fmi2(enter(c, Call::keep_state, __func__,
                       [&](Instance& me) { return me.read_state(bytes, size, state); }));
}

fmi2Status fmi2DoStep(fmi2Component c, fmi2Real time, fmi2Real size, fmi2Boolean) {
  return as_fmi2(enter(c, Call::step, __func__, [&](Instance& me) {
    StepReport report;
    return me.do_step(time, size, report);
  }));
}

fmi2Status fmi2GetRealStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Real* value) {
  return answer<fmi2Real>(c, __func__, kind == fmi2LastSuccessfulTime, value,
                          [](const Instance& me) { return me.time(); });
}
fmi2Status fmi2GetBooleanStatus(fmi2Component c, const fmi2StatusKind kind, fmi2Boolean* value) {
  return answer<fmi2Boolean>(c, __func__, kind == fmi2Terminated, value,
                             [](const Instance&) { return fmi2False; });
}
fmi2Status fmi2GetStatus(fmi2Component c, const fmi2StatusKind, fmi2Status* value) {
  return answer<fmi2Status>(c, __func__, false, value, nullptr);
}
fmi2Status fmi2GetIntegerStatus(fmi2Component c, const fmi2StatusKind, fmi2Integer* value) {
  return answer<fmi2Integer>(c, __func__, false, value, nullptr);
}
fmi2Status fmi2GetStringStatus(fmi2Component c, const fmi2StatusKind, fmi2String* value) {
  return answer<fmi2String>(c, __func__, false, value, nullptr);
}

// What modelDescription.xml does not offer.

fmi2Status fmi2CancelStep(fmi2Component c) { return fmi2_not_offered(c, __func__); }
fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference[], size_t,
                                        const fmi2ValueReference[], size_t, const fmi2Real[],
                                        fmi2Real[]) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t,
                                       const fmi2Integer[], const fmi2Real[]) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference[], size_t,
                                        const fmi2Integer[], fmi2Real[]) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2EnterEventMode(fmi2Component c) { return fmi2_not_offered(c, __func__); }
fmi2Status fmi2NewDiscreteStates(fmi2Component c, fmi2EventInfo*) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2EnterContinuousTimeMode(fmi2Component c) { return fmi2_not_offered(c, __func__); }
fmi2Status fmi2CompletedIntegratorStep(fmi2Component c, fmi2Boolean, fmi2Boolean*, fmi2Boolean*) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2SetTime(fmi2Component c, fmi2Real) { return fmi2_not_offered(c, __func__); }
fmi2Status fmi2SetContinuousStates(fmi2Component c, const fmi2Real[], size_t) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2GetDerivatives(fmi2Component c, fmi2Real[], size_t) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2GetEventIndicators(fmi2Component c, fmi2Real[], size_t) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2GetContinuousStates(fmi2Component c, fmi2Real[], size_t) {
  return fmi2_not_offered(c, __func__);
}
fmi2Status fmi2GetNominalsOfContinuousStates(fmi2Component c, fmi2Real[], size_t) {
  return fmi2_not_offered(c, __func__);
}
