#pragma once
// The functions of FMI 2 and of FMI 3 under one set of names, so that one test goes over both. A
// status is its number.
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "fmi/fake_functions.hpp"
#include "fmi/fmi2_standard.h"
#include "fmi/fmi3_standard.h"

namespace floatframe::testing {

inline constexpr int ok = 0, warning = 1, discard = 2, error = 3;
inline constexpr std::uint32_t input0 = 0x10000, output0 = 0x20000, parameter0 = 0x30000,
                               figure0 = 0x40000;

/// (status, category, message) that an importer has received.
struct Heard {
  std::vector<std::pair<int, std::string>> categories;
  std::vector<std::string> messages;
  bool has(const std::string& part) const {
    for (const std::string& m : messages)
      if (m.find(part) != std::string::npos) return true;
    return false;
  }
};

struct Fmi2 {
  static constexpr int version = 2;
  static void hear(void* environment, fmi2String, fmi2Status status, fmi2String category,
                   fmi2String message, ...) {
    auto& heard = *static_cast<Heard*>(environment);
    heard.categories.emplace_back(int(status), category);
    heard.messages.emplace_back(message);
  }
  static void* make(Heard& heard, bool logging = true, const char* token = "0123abcd") {
    std::string uri = "file://" + fake_resources().string();
    for (std::size_t k = uri.find(' '); k != std::string::npos; k = uri.find(' '))
      uri.replace(k, 1, "%20");
    const fmi2CallbackFunctions importer{&hear, nullptr, nullptr, nullptr, &heard};
    return fmi2Instantiate("car", fmi2CoSimulation, token, uri.c_str(), &importer, 0, logging);
  }
  static void free(void* c) { fmi2FreeInstance(c); }
  static int log(void* c, bool on, std::size_t n, const char* const* names) {
    return fmi2SetDebugLogging(c, on, n, names);
  }
  static int set_up(void* c, double start, bool has_stop, double stop) {
    return fmi2SetupExperiment(c, 0, 0.0, start, has_stop, stop);
  }
  static int enter(void* c) { return fmi2EnterInitializationMode(c); }
  static int exit(void* c) { return fmi2ExitInitializationMode(c); }
  static int terminate(void* c) { return fmi2Terminate(c); }
  static int reset(void* c) { return fmi2Reset(c); }
  static int get(void* c, const std::uint32_t* r, std::size_t n, double* v) {
    return fmi2GetReal(c, r, n, v);
  }
  static int set(void* c, const std::uint32_t* r, std::size_t n, const double* v) {
    return fmi2SetReal(c, r, n, v);
  }
  static int step(void* c, double t, double h) { return fmi2DoStep(c, t, h, 1); }
  static int get_state(void* c, void** s) { return fmi2GetFMUstate(c, s); }
  static int set_state(void* c, void* s) { return fmi2SetFMUstate(c, s); }
  static int free_state(void* c, void** s) { return fmi2FreeFMUstate(c, s); }
  static int size(void* c, void* s, std::size_t* n) { return fmi2SerializedFMUstateSize(c, s, n); }
  static int write(void* c, void* s, std::uint8_t* b, std::size_t n) {
    return fmi2SerializeFMUstate(c, s, reinterpret_cast<fmi2Byte*>(b), n);
  }
  static int read(void* c, const std::uint8_t* b, std::size_t n, void** s) {
    return fmi2DeSerializeFMUstate(c, reinterpret_cast<const fmi2Byte*>(b), n, s);
  }
  /// One of the functions that are never allowed.
  static int never(void* c, unsigned which);
  static constexpr unsigned never_count = 14;
  /// A get of values of another type.
  static int get_other(void* c, const std::uint32_t* r, std::size_t n) {
    return fmi2GetInteger(c, r, n, nullptr);
  }
};

struct Fmi3 {
  static constexpr int version = 3;
  static void hear(void* environment, fmi3Status status, fmi3String category, fmi3String message) {
    auto& heard = *static_cast<Heard*>(environment);
    heard.categories.emplace_back(int(status), category);
    heard.messages.emplace_back(message);
  }
  static void* make(Heard& heard, bool logging = true, const char* token = "{0123-ABCD}",
                    bool early = false, fmi3IntermediateUpdateCallback update = nullptr) {
    return fmi3InstantiateCoSimulation("car", token, fake_resources().c_str(), false, logging,
                                       false, early, nullptr, 0, &heard, &hear, update);
  }
  static void free(void* c) { fmi3FreeInstance(c); }
  static int log(void* c, bool on, std::size_t n, const char* const* names) {
    return fmi3SetDebugLogging(c, on, n, names);
  }
  static int set_up(void*, double, bool, double) { return ok; }
  static int enter(void* c, double start = 0.0, bool has_stop = false, double stop = 0.0) {
    return fmi3EnterInitializationMode(c, false, 0.0, start, has_stop, stop);
  }
  static int exit(void* c) { return fmi3ExitInitializationMode(c); }
  static int terminate(void* c) { return fmi3Terminate(c); }
  static int reset(void* c) { return fmi3Reset(c); }
  static int get(void* c, const std::uint32_t* r, std::size_t n, double* v) {
    return fmi3GetFloat64(c, r, n, v, n);
  }
  static int set(void* c, const std::uint32_t* r, std::size_t n, const double* v) {
    return fmi3SetFloat64(c, r, n, v, n);
  }
  static int step(void* c, double t, double h) {
    fmi3Boolean event = true, end = true, early = true;
    fmi3Float64 last = 0.0;
    return fmi3DoStep(c, t, h, true, &event, &end, &early, &last);
  }
  static int get_state(void* c, void** s) { return fmi3GetFMUState(c, s); }
  static int set_state(void* c, void* s) { return fmi3SetFMUState(c, s); }
  static int free_state(void* c, void** s) { return fmi3FreeFMUState(c, s); }
  static int size(void* c, void* s, std::size_t* n) { return fmi3SerializedFMUStateSize(c, s, n); }
  static int write(void* c, void* s, std::uint8_t* b, std::size_t n) {
    return fmi3SerializeFMUState(c, s, b, n);
  }
  static int read(void* c, const std::uint8_t* b, std::size_t n, void** s) {
    return fmi3DeserializeFMUState(c, b, n, s);
  }
  static int never(void* c, unsigned which);
  static constexpr unsigned never_count = 16;
  static int get_other(void* c, const std::uint32_t* r, std::size_t n) {
    return fmi3GetInt32(c, r, n, nullptr, n);
  }
};

inline int Fmi2::never(void* c, unsigned which) {
  switch (which) {
    case 0:
      return fmi2CancelStep(c);
    case 1:
      return fmi2GetDirectionalDerivative(c, nullptr, 1, nullptr, 1, nullptr, nullptr);
    case 2:
      return fmi2SetRealInputDerivatives(c, nullptr, 1, nullptr, nullptr);
    case 3:
      return fmi2GetRealOutputDerivatives(c, nullptr, 1, nullptr, nullptr);
    case 4:
      return fmi2EnterEventMode(c);
    case 5:
      return fmi2NewDiscreteStates(c, nullptr);
    case 6:
      return fmi2EnterContinuousTimeMode(c);
    case 7:
      return fmi2CompletedIntegratorStep(c, 1, nullptr, nullptr);
    case 8:
      return fmi2SetTime(c, 0.0);
    case 9:
      return fmi2SetContinuousStates(c, nullptr, 1);
    case 10:
      return fmi2GetDerivatives(c, nullptr, 1);
    case 11:
      return fmi2GetEventIndicators(c, nullptr, 1);
    case 12:
      return fmi2GetContinuousStates(c, nullptr, 1);
    default:
      return fmi2GetNominalsOfContinuousStates(c, nullptr, 1);
  }
}

inline int Fmi3::never(void* c, unsigned which) {
  switch (which) {
    case 0:
      return fmi3EnterEventMode(c);
    case 1:
      return fmi3EnterStepMode(c);
    case 2:
      return fmi3EnterConfigurationMode(c);
    case 3:
      return fmi3ExitConfigurationMode(c);
    case 4:
      return fmi3UpdateDiscreteStates(c, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
    case 5:
      return fmi3EvaluateDiscreteStates(c);
    case 6:
      return fmi3GetNumberOfVariableDependencies(c, output0, nullptr);
    case 7:
      return fmi3GetDirectionalDerivative(c, nullptr, 1, nullptr, 1, nullptr, 1, nullptr, 1);
    case 8:
      return fmi3GetAdjointDerivative(c, nullptr, 1, nullptr, 1, nullptr, 1, nullptr, 1);
    case 9:
      return fmi3GetOutputDerivatives(c, nullptr, 1, nullptr, nullptr, 1);
    case 10:
      return fmi3GetClock(c, nullptr, 1, nullptr);
    case 11:
      return fmi3GetIntervalDecimal(c, nullptr, 1, nullptr, nullptr);
    case 12:
      return fmi3SetShiftFraction(c, nullptr, 1, nullptr, nullptr);
    case 13:
      return fmi3SetTime(c, 0.0);
    case 14:
      return fmi3GetNumberOfContinuousStates(c, nullptr);
    default:
      return fmi3ActivateModelPartition(c, 1, 0.0);
  }
}

}  // namespace floatframe::testing
