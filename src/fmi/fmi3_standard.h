/* FMI 3.0 (3.0.2) in C: the types and the functions of the standard, as its text defines them
 * (https://fmi-standard.org/docs/3.0). Names, values and signatures are the standard's;
 * tests/fmi/standard_headers_test.py compares them with the headers it publishes.
 *
 * For a function `fmi3Name` there is the type `fmi3NameTYPE`, which masters take for what they load.
 * FMI_STRUCTURES_ELSEWHERE leaves out what C lets nobody declare twice, for that comparison. */
#ifndef FLOATFRAME_FMI3_STANDARD_H
#define FLOATFRAME_FMI3_STANDARD_H
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifndef FMI_EXPORT
#ifdef _WIN32
#define FMI_EXPORT __declspec(dllexport)
#else
#define FMI_EXPORT __attribute__((visibility("default")))
#endif
#endif

#ifdef __cplusplus
extern "C" {
#endif

typedef void* fmi3Instance;
typedef void* fmi3InstanceEnvironment;
typedef void* fmi3FMUState;
typedef uint32_t fmi3ValueReference;
typedef float fmi3Float32;
typedef double fmi3Float64;
typedef int8_t fmi3Int8;
typedef uint8_t fmi3UInt8;
typedef int16_t fmi3Int16;
typedef uint16_t fmi3UInt16;
typedef int32_t fmi3Int32;
typedef uint32_t fmi3UInt32;
typedef int64_t fmi3Int64;
typedef uint64_t fmi3UInt64;
typedef bool fmi3Boolean;
typedef char fmi3Char;
typedef const fmi3Char* fmi3String;
typedef uint8_t fmi3Byte;
typedef const fmi3Byte* fmi3Binary;
typedef bool fmi3Clock;

#ifndef FMI_STRUCTURES_ELSEWHERE
#define fmi3True true
#define fmi3False false
#define fmi3ClockActive true
#define fmi3ClockInactive false
typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef enum {
  fmi3Independent,
  fmi3Constant,
  fmi3Fixed,
  fmi3Tunable,
  fmi3Discrete,
  fmi3Dependent
} fmi3DependencyKind;
typedef enum {
  fmi3IntervalNotYetKnown,
  fmi3IntervalUnchanged,
  fmi3IntervalChanged
} fmi3IntervalQualifier;
#endif

/* What the importer brings. */
typedef void (*fmi3LogMessageCallback)(fmi3InstanceEnvironment, fmi3Status, fmi3String category,
                                       fmi3String message);
typedef void (*fmi3ClockUpdateCallback)(fmi3InstanceEnvironment);
typedef void (*fmi3IntermediateUpdateCallback)(fmi3InstanceEnvironment, fmi3Float64 time,
                                               fmi3Boolean set_requested, fmi3Boolean get_allowed,
                                               fmi3Boolean step_finished,
                                               fmi3Boolean can_return_early,
                                               fmi3Boolean* early_return_requested,
                                               fmi3Float64* early_return_time);
typedef void (*fmi3LockPreemptionCallback)();
typedef void (*fmi3UnlockPreemptionCallback)();

/* Of all kinds of FMU. */
typedef const char* fmi3GetVersionTYPE(void);
typedef fmi3Status fmi3SetDebugLoggingTYPE(fmi3Instance, fmi3Boolean on, size_t count,
                                           const fmi3String categories[]);
typedef fmi3Instance fmi3InstantiateModelExchangeTYPE(fmi3String instance, fmi3String token,
                                                      fmi3String resources, fmi3Boolean visible,
                                                      fmi3Boolean logging, fmi3InstanceEnvironment,
                                                      fmi3LogMessageCallback);
typedef fmi3Instance fmi3InstantiateCoSimulationTYPE(
    fmi3String instance, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3Boolean event_mode, fmi3Boolean early_return,
    const fmi3ValueReference intermediate[], size_t count, fmi3InstanceEnvironment,
    fmi3LogMessageCallback, fmi3IntermediateUpdateCallback);
typedef fmi3Instance fmi3InstantiateScheduledExecutionTYPE(
    fmi3String instance, fmi3String token, fmi3String resources, fmi3Boolean visible,
    fmi3Boolean logging, fmi3InstanceEnvironment, fmi3LogMessageCallback, fmi3ClockUpdateCallback,
    fmi3LockPreemptionCallback, fmi3UnlockPreemptionCallback);
typedef void fmi3FreeInstanceTYPE(fmi3Instance);
typedef fmi3Status fmi3EnterInitializationModeTYPE(fmi3Instance, fmi3Boolean has_tolerance,
                                                   fmi3Float64 tolerance, fmi3Float64 start,
                                                   fmi3Boolean has_stop, fmi3Float64 stop);
typedef fmi3Status fmi3ExitInitializationModeTYPE(fmi3Instance);
typedef fmi3Status fmi3EnterEventModeTYPE(fmi3Instance);
typedef fmi3Status fmi3TerminateTYPE(fmi3Instance);
typedef fmi3Status fmi3ResetTYPE(fmi3Instance);

#define FMI3_ACCESS(Type)                                                                       \
  typedef fmi3Status fmi3Get##Type##TYPE(fmi3Instance, const fmi3ValueReference[], size_t,      \
                                         fmi3##Type[], size_t);                                 \
  typedef fmi3Status fmi3Set##Type##TYPE(fmi3Instance, const fmi3ValueReference[], size_t,      \
                                         const fmi3##Type[], size_t);
FMI3_ACCESS(Float32)
FMI3_ACCESS(Float64)
FMI3_ACCESS(Int8)
FMI3_ACCESS(UInt8)
FMI3_ACCESS(Int16)
FMI3_ACCESS(UInt16)
FMI3_ACCESS(Int32)
FMI3_ACCESS(UInt32)
FMI3_ACCESS(Int64)
FMI3_ACCESS(UInt64)
FMI3_ACCESS(Boolean)
FMI3_ACCESS(String)
#undef FMI3_ACCESS
typedef fmi3Status fmi3GetBinaryTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                     size_t sizes[], fmi3Binary[], size_t);
typedef fmi3Status fmi3SetBinaryTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                     const size_t sizes[], const fmi3Binary[], size_t);
typedef fmi3Status fmi3GetClockTYPE(fmi3Instance, const fmi3ValueReference[], size_t, fmi3Clock[]);
typedef fmi3Status fmi3SetClockTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                    const fmi3Clock[]);

typedef fmi3Status fmi3GetNumberOfVariableDependenciesTYPE(fmi3Instance, fmi3ValueReference,
                                                           size_t*);
typedef fmi3Status fmi3GetVariableDependenciesTYPE(fmi3Instance, fmi3ValueReference dependent,
                                                   size_t dependent_elements[],
                                                   fmi3ValueReference independents[],
                                                   size_t independent_elements[],
                                                   fmi3DependencyKind[], size_t);
typedef fmi3Status fmi3GetFMUStateTYPE(fmi3Instance, fmi3FMUState*);
typedef fmi3Status fmi3SetFMUStateTYPE(fmi3Instance, fmi3FMUState);
typedef fmi3Status fmi3FreeFMUStateTYPE(fmi3Instance, fmi3FMUState*);
typedef fmi3Status fmi3SerializedFMUStateSizeTYPE(fmi3Instance, fmi3FMUState, size_t*);
typedef fmi3Status fmi3SerializeFMUStateTYPE(fmi3Instance, fmi3FMUState, fmi3Byte[], size_t);
typedef fmi3Status fmi3DeserializeFMUStateTYPE(fmi3Instance, const fmi3Byte[], size_t,
                                               fmi3FMUState*);
typedef fmi3Status fmi3GetDirectionalDerivativeTYPE(
    fmi3Instance, const fmi3ValueReference unknowns[], size_t, const fmi3ValueReference knowns[],
    size_t, const fmi3Float64 seed[], size_t, fmi3Float64 sensitivity[], size_t);
typedef fmi3Status fmi3GetAdjointDerivativeTYPE(
    fmi3Instance, const fmi3ValueReference unknowns[], size_t, const fmi3ValueReference knowns[],
    size_t, const fmi3Float64 seed[], size_t, fmi3Float64 sensitivity[], size_t);
typedef fmi3Status fmi3EnterConfigurationModeTYPE(fmi3Instance);
typedef fmi3Status fmi3ExitConfigurationModeTYPE(fmi3Instance);
typedef fmi3Status fmi3GetIntervalDecimalTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                              fmi3Float64 intervals[], fmi3IntervalQualifier[]);
typedef fmi3Status fmi3GetIntervalFractionTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                               fmi3UInt64 counters[], fmi3UInt64 resolutions[],
                                               fmi3IntervalQualifier[]);
typedef fmi3Status fmi3GetShiftDecimalTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                           fmi3Float64 shifts[]);
typedef fmi3Status fmi3GetShiftFractionTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                            fmi3UInt64 counters[], fmi3UInt64 resolutions[]);
typedef fmi3Status fmi3SetIntervalDecimalTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                              const fmi3Float64 intervals[]);
typedef fmi3Status fmi3SetIntervalFractionTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                               const fmi3UInt64 counters[],
                                               const fmi3UInt64 resolutions[]);
typedef fmi3Status fmi3SetShiftDecimalTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                           const fmi3Float64 shifts[]);
typedef fmi3Status fmi3SetShiftFractionTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                            const fmi3UInt64 counters[],
                                            const fmi3UInt64 resolutions[]);
typedef fmi3Status fmi3EvaluateDiscreteStatesTYPE(fmi3Instance);
typedef fmi3Status fmi3UpdateDiscreteStatesTYPE(fmi3Instance, fmi3Boolean* again,
                                                fmi3Boolean* terminate,
                                                fmi3Boolean* nominals_changed,
                                                fmi3Boolean* states_changed,
                                                fmi3Boolean* has_next_event,
                                                fmi3Float64* next_event);

/* Of model exchange. */
typedef fmi3Status fmi3EnterContinuousTimeModeTYPE(fmi3Instance);
typedef fmi3Status fmi3CompletedIntegratorStepTYPE(fmi3Instance, fmi3Boolean no_way_back,
                                                   fmi3Boolean* enter_event_mode,
                                                   fmi3Boolean* terminate);
typedef fmi3Status fmi3SetTimeTYPE(fmi3Instance, fmi3Float64);
typedef fmi3Status fmi3SetContinuousStatesTYPE(fmi3Instance, const fmi3Float64[], size_t);
typedef fmi3Status fmi3GetContinuousStateDerivativesTYPE(fmi3Instance, fmi3Float64[], size_t);
typedef fmi3Status fmi3GetEventIndicatorsTYPE(fmi3Instance, fmi3Float64[], size_t);
typedef fmi3Status fmi3GetContinuousStatesTYPE(fmi3Instance, fmi3Float64[], size_t);
typedef fmi3Status fmi3GetNominalsOfContinuousStatesTYPE(fmi3Instance, fmi3Float64[], size_t);
typedef fmi3Status fmi3GetNumberOfEventIndicatorsTYPE(fmi3Instance, size_t*);
typedef fmi3Status fmi3GetNumberOfContinuousStatesTYPE(fmi3Instance, size_t*);

/* Of co-simulation and of scheduled execution. */
typedef fmi3Status fmi3EnterStepModeTYPE(fmi3Instance);
typedef fmi3Status fmi3GetOutputDerivativesTYPE(fmi3Instance, const fmi3ValueReference[], size_t,
                                                const fmi3Int32 orders[], fmi3Float64[], size_t);
typedef fmi3Status fmi3DoStepTYPE(fmi3Instance, fmi3Float64 time, fmi3Float64 size,
                                  fmi3Boolean no_way_back, fmi3Boolean* event_handling_needed,
                                  fmi3Boolean* terminate, fmi3Boolean* early_return,
                                  fmi3Float64* last_successful_time);
typedef fmi3Status fmi3ActivateModelPartitionTYPE(fmi3Instance, fmi3ValueReference clock,
                                                  fmi3Float64 time);

FMI_EXPORT fmi3GetVersionTYPE fmi3GetVersion;
FMI_EXPORT fmi3SetDebugLoggingTYPE fmi3SetDebugLogging;
FMI_EXPORT fmi3InstantiateModelExchangeTYPE fmi3InstantiateModelExchange;
FMI_EXPORT fmi3InstantiateCoSimulationTYPE fmi3InstantiateCoSimulation;
FMI_EXPORT fmi3InstantiateScheduledExecutionTYPE fmi3InstantiateScheduledExecution;
FMI_EXPORT fmi3FreeInstanceTYPE fmi3FreeInstance;
FMI_EXPORT fmi3EnterInitializationModeTYPE fmi3EnterInitializationMode;
FMI_EXPORT fmi3ExitInitializationModeTYPE fmi3ExitInitializationMode;
FMI_EXPORT fmi3EnterEventModeTYPE fmi3EnterEventMode;
FMI_EXPORT fmi3TerminateTYPE fmi3Terminate;
FMI_EXPORT fmi3ResetTYPE fmi3Reset;
FMI_EXPORT fmi3GetFloat32TYPE fmi3GetFloat32;
FMI_EXPORT fmi3GetFloat64TYPE fmi3GetFloat64;
FMI_EXPORT fmi3GetInt8TYPE fmi3GetInt8;
FMI_EXPORT fmi3GetUInt8TYPE fmi3GetUInt8;
FMI_EXPORT fmi3GetInt16TYPE fmi3GetInt16;
FMI_EXPORT fmi3GetUInt16TYPE fmi3GetUInt16;
FMI_EXPORT fmi3GetInt32TYPE fmi3GetInt32;
FMI_EXPORT fmi3GetUInt32TYPE fmi3GetUInt32;
FMI_EXPORT fmi3GetInt64TYPE fmi3GetInt64;
FMI_EXPORT fmi3GetUInt64TYPE fmi3GetUInt64;
FMI_EXPORT fmi3GetBooleanTYPE fmi3GetBoolean;
FMI_EXPORT fmi3GetStringTYPE fmi3GetString;
FMI_EXPORT fmi3GetBinaryTYPE fmi3GetBinary;
FMI_EXPORT fmi3GetClockTYPE fmi3GetClock;
FMI_EXPORT fmi3SetFloat32TYPE fmi3SetFloat32;
FMI_EXPORT fmi3SetFloat64TYPE fmi3SetFloat64;
FMI_EXPORT fmi3SetInt8TYPE fmi3SetInt8;
FMI_EXPORT fmi3SetUInt8TYPE fmi3SetUInt8;
FMI_EXPORT fmi3SetInt16TYPE fmi3SetInt16;
FMI_EXPORT fmi3SetUInt16TYPE fmi3SetUInt16;
FMI_EXPORT fmi3SetInt32TYPE fmi3SetInt32;
FMI_EXPORT fmi3SetUInt32TYPE fmi3SetUInt32;
FMI_EXPORT fmi3SetInt64TYPE fmi3SetInt64;
FMI_EXPORT fmi3SetUInt64TYPE fmi3SetUInt64;
FMI_EXPORT fmi3SetBooleanTYPE fmi3SetBoolean;
FMI_EXPORT fmi3SetStringTYPE fmi3SetString;
FMI_EXPORT fmi3SetBinaryTYPE fmi3SetBinary;
FMI_EXPORT fmi3SetClockTYPE fmi3SetClock;
FMI_EXPORT fmi3GetNumberOfVariableDependenciesTYPE fmi3GetNumberOfVariableDependencies;
FMI_EXPORT fmi3GetVariableDependenciesTYPE fmi3GetVariableDependencies;
FMI_EXPORT fmi3GetFMUStateTYPE fmi3GetFMUState;
FMI_EXPORT fmi3SetFMUStateTYPE fmi3SetFMUState;
FMI_EXPORT fmi3FreeFMUStateTYPE fmi3FreeFMUState;
FMI_EXPORT fmi3SerializedFMUStateSizeTYPE fmi3SerializedFMUStateSize;
FMI_EXPORT fmi3SerializeFMUStateTYPE fmi3SerializeFMUState;
FMI_EXPORT fmi3DeserializeFMUStateTYPE fmi3DeserializeFMUState;
FMI_EXPORT fmi3GetDirectionalDerivativeTYPE fmi3GetDirectionalDerivative;
FMI_EXPORT fmi3GetAdjointDerivativeTYPE fmi3GetAdjointDerivative;
FMI_EXPORT fmi3EnterConfigurationModeTYPE fmi3EnterConfigurationMode;
FMI_EXPORT fmi3ExitConfigurationModeTYPE fmi3ExitConfigurationMode;
FMI_EXPORT fmi3GetIntervalDecimalTYPE fmi3GetIntervalDecimal;
FMI_EXPORT fmi3GetIntervalFractionTYPE fmi3GetIntervalFraction;
FMI_EXPORT fmi3GetShiftDecimalTYPE fmi3GetShiftDecimal;
FMI_EXPORT fmi3GetShiftFractionTYPE fmi3GetShiftFraction;
FMI_EXPORT fmi3SetIntervalDecimalTYPE fmi3SetIntervalDecimal;
FMI_EXPORT fmi3SetIntervalFractionTYPE fmi3SetIntervalFraction;
FMI_EXPORT fmi3SetShiftDecimalTYPE fmi3SetShiftDecimal;
FMI_EXPORT fmi3SetShiftFractionTYPE fmi3SetShiftFraction;
FMI_EXPORT fmi3EvaluateDiscreteStatesTYPE fmi3EvaluateDiscreteStates;
FMI_EXPORT fmi3UpdateDiscreteStatesTYPE fmi3UpdateDiscreteStates;
FMI_EXPORT fmi3EnterContinuousTimeModeTYPE fmi3EnterContinuousTimeMode;
FMI_EXPORT fmi3CompletedIntegratorStepTYPE fmi3CompletedIntegratorStep;
FMI_EXPORT fmi3SetTimeTYPE fmi3SetTime;
FMI_EXPORT fmi3SetContinuousStatesTYPE fmi3SetContinuousStates;
FMI_EXPORT fmi3GetContinuousStateDerivativesTYPE fmi3GetContinuousStateDerivatives;
FMI_EXPORT fmi3GetEventIndicatorsTYPE fmi3GetEventIndicators;
FMI_EXPORT fmi3GetContinuousStatesTYPE fmi3GetContinuousStates;
FMI_EXPORT fmi3GetNominalsOfContinuousStatesTYPE fmi3GetNominalsOfContinuousStates;
FMI_EXPORT fmi3GetNumberOfEventIndicatorsTYPE fmi3GetNumberOfEventIndicators;
FMI_EXPORT fmi3GetNumberOfContinuousStatesTYPE fmi3GetNumberOfContinuousStates;
FMI_EXPORT fmi3EnterStepModeTYPE fmi3EnterStepMode;
FMI_EXPORT fmi3GetOutputDerivativesTYPE fmi3GetOutputDerivatives;
FMI_EXPORT fmi3DoStepTYPE fmi3DoStep;
FMI_EXPORT fmi3ActivateModelPartitionTYPE fmi3ActivateModelPartition;

#ifdef __cplusplus
}
#endif
#endif
