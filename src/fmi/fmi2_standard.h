/* FMI 2.0 (2.0.4) in C: the types and the functions of the standard, as its text defines them
 * (https://fmi-standard.org, chapters 2.1, 3.2 and 4.2). Names, values and signatures are the
 * standard's; tests/fmi/standard_headers_test.py compares them with the headers it publishes.
 *
 * For a function `fmi2Name` there is the type `fmi2NameTYPE`, which masters take for what they load.
 * FMI_STRUCTURES_ELSEWHERE leaves out what C lets nobody declare twice, for that comparison. */
#ifndef FLOATFRAME_FMI2_STANDARD_H
#define FLOATFRAME_FMI2_STANDARD_H
#include <stddef.h>

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

typedef void* fmi2Component;
typedef void* fmi2ComponentEnvironment;
typedef void* fmi2FMUstate;
typedef unsigned int fmi2ValueReference;
typedef double fmi2Real;
typedef int fmi2Integer;
typedef int fmi2Boolean;
typedef char fmi2Char;
typedef const fmi2Char* fmi2String;
typedef char fmi2Byte;

#ifndef FMI_STRUCTURES_ELSEWHERE
#define fmi2True 1
#define fmi2False 0
typedef enum { fmi2OK, fmi2Warning, fmi2Discard, fmi2Error, fmi2Fatal, fmi2Pending } fmi2Status;
typedef enum { fmi2ModelExchange, fmi2CoSimulation } fmi2Type;
typedef enum {
  fmi2DoStepStatus,
  fmi2PendingStatus,
  fmi2LastSuccessfulTime,
  fmi2Terminated
} fmi2StatusKind;
#endif

/* What the importer brings. `message` is a format in the manner of printf. */
typedef void (*fmi2CallbackLogger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status,
                                   fmi2String category, fmi2String message, ...);
typedef void* (*fmi2CallbackAllocateMemory)(size_t count, size_t size);
typedef void (*fmi2CallbackFreeMemory)(void*);
typedef void (*fmi2StepFinished)(fmi2ComponentEnvironment, fmi2Status);

#ifndef FMI_STRUCTURES_ELSEWHERE
typedef struct {
  fmi2CallbackLogger logger;
  fmi2CallbackAllocateMemory allocateMemory;
  fmi2CallbackFreeMemory freeMemory;
  fmi2StepFinished stepFinished;
  fmi2ComponentEnvironment componentEnvironment;
} fmi2CallbackFunctions;

typedef struct {
  fmi2Boolean newDiscreteStatesNeeded;
  fmi2Boolean terminateSimulation;
  fmi2Boolean nominalsOfContinuousStatesChanged;
  fmi2Boolean valuesOfContinuousStatesChanged;
  fmi2Boolean nextEventTimeDefined;
  fmi2Real nextEventTime;
} fmi2EventInfo;
#endif

/* Of both kinds of FMU. */
typedef const char* fmi2GetTypesPlatformTYPE(void);
typedef const char* fmi2GetVersionTYPE(void);
typedef fmi2Status fmi2SetDebugLoggingTYPE(fmi2Component, fmi2Boolean on, size_t count,
                                           const fmi2String categories[]);
typedef fmi2Component fmi2InstantiateTYPE(fmi2String instance, fmi2Type, fmi2String guid,
                                          fmi2String resources, const fmi2CallbackFunctions*,
                                          fmi2Boolean visible, fmi2Boolean logging);
typedef void fmi2FreeInstanceTYPE(fmi2Component);
typedef fmi2Status fmi2SetupExperimentTYPE(fmi2Component, fmi2Boolean has_tolerance,
                                           fmi2Real tolerance, fmi2Real start, fmi2Boolean has_stop,
                                           fmi2Real stop);
typedef fmi2Status fmi2EnterInitializationModeTYPE(fmi2Component);
typedef fmi2Status fmi2ExitInitializationModeTYPE(fmi2Component);
typedef fmi2Status fmi2TerminateTYPE(fmi2Component);
typedef fmi2Status fmi2ResetTYPE(fmi2Component);

#define FMI2_ACCESS(Type)                                                                      \
  typedef fmi2Status fmi2Get##Type##TYPE(fmi2Component, const fmi2ValueReference[], size_t,    \
                                         fmi2##Type[]);                                        \
  typedef fmi2Status fmi2Set##Type##TYPE(fmi2Component, const fmi2ValueReference[], size_t,    \
                                         const fmi2##Type[]);
FMI2_ACCESS(Real)
FMI2_ACCESS(Integer)
FMI2_ACCESS(Boolean)
FMI2_ACCESS(String)
#undef FMI2_ACCESS

typedef fmi2Status fmi2GetFMUstateTYPE(fmi2Component, fmi2FMUstate*);
typedef fmi2Status fmi2SetFMUstateTYPE(fmi2Component, fmi2FMUstate);
typedef fmi2Status fmi2FreeFMUstateTYPE(fmi2Component, fmi2FMUstate*);
typedef fmi2Status fmi2SerializedFMUstateSizeTYPE(fmi2Component, fmi2FMUstate, size_t*);
typedef fmi2Status fmi2SerializeFMUstateTYPE(fmi2Component, fmi2FMUstate, fmi2Byte[], size_t);
typedef fmi2Status fmi2DeSerializeFMUstateTYPE(fmi2Component, const fmi2Byte[], size_t,
                                               fmi2FMUstate*);
typedef fmi2Status fmi2GetDirectionalDerivativeTYPE(fmi2Component,
                                                    const fmi2ValueReference unknowns[], size_t,
                                                    const fmi2ValueReference knowns[], size_t,
                                                    const fmi2Real direction[],
                                                    fmi2Real derivatives[]);

/* Of model exchange. */
typedef fmi2Status fmi2EnterEventModeTYPE(fmi2Component);
typedef fmi2Status fmi2NewDiscreteStatesTYPE(fmi2Component, fmi2EventInfo*);
typedef fmi2Status fmi2EnterContinuousTimeModeTYPE(fmi2Component);
typedef fmi2Status fmi2CompletedIntegratorStepTYPE(fmi2Component, fmi2Boolean no_way_back,
                                                   fmi2Boolean* enter_event_mode,
                                                   fmi2Boolean* terminate);
typedef fmi2Status fmi2SetTimeTYPE(fmi2Component, fmi2Real);
typedef fmi2Status fmi2SetContinuousStatesTYPE(fmi2Component, const fmi2Real[], size_t);
typedef fmi2Status fmi2GetDerivativesTYPE(fmi2Component, fmi2Real[], size_t);
typedef fmi2Status fmi2GetEventIndicatorsTYPE(fmi2Component, fmi2Real[], size_t);
typedef fmi2Status fmi2GetContinuousStatesTYPE(fmi2Component, fmi2Real[], size_t);
typedef fmi2Status fmi2GetNominalsOfContinuousStatesTYPE(fmi2Component, fmi2Real[], size_t);

/* Of co-simulation. */
typedef fmi2Status fmi2SetRealInputDerivativesTYPE(fmi2Component, const fmi2ValueReference[],
                                                   size_t, const fmi2Integer order[],
                                                   const fmi2Real[]);
typedef fmi2Status fmi2GetRealOutputDerivativesTYPE(fmi2Component, const fmi2ValueReference[],
                                                    size_t, const fmi2Integer order[], fmi2Real[]);
typedef fmi2Status fmi2DoStepTYPE(fmi2Component, fmi2Real time, fmi2Real size,
                                  fmi2Boolean no_way_back);
typedef fmi2Status fmi2CancelStepTYPE(fmi2Component);
typedef fmi2Status fmi2GetStatusTYPE(fmi2Component, const fmi2StatusKind, fmi2Status*);
typedef fmi2Status fmi2GetRealStatusTYPE(fmi2Component, const fmi2StatusKind, fmi2Real*);
typedef fmi2Status fmi2GetIntegerStatusTYPE(fmi2Component, const fmi2StatusKind, fmi2Integer*);
typedef fmi2Status fmi2GetBooleanStatusTYPE(fmi2Component, const fmi2StatusKind, fmi2Boolean*);
typedef fmi2Status fmi2GetStringStatusTYPE(fmi2Component, const fmi2StatusKind, fmi2String*);

FMI_EXPORT fmi2GetTypesPlatformTYPE fmi2GetTypesPlatform;
FMI_EXPORT fmi2GetVersionTYPE fmi2GetVersion;
FMI_EXPORT fmi2SetDebugLoggingTYPE fmi2SetDebugLogging;
FMI_EXPORT fmi2InstantiateTYPE fmi2Instantiate;
FMI_EXPORT fmi2FreeInstanceTYPE fmi2FreeInstance;
FMI_EXPORT fmi2SetupExperimentTYPE fmi2SetupExperiment;
FMI_EXPORT fmi2EnterInitializationModeTYPE fmi2EnterInitializationMode;
FMI_EXPORT fmi2ExitInitializationModeTYPE fmi2ExitInitializationMode;
FMI_EXPORT fmi2TerminateTYPE fmi2Terminate;
FMI_EXPORT fmi2ResetTYPE fmi2Reset;
FMI_EXPORT fmi2GetRealTYPE fmi2GetReal;
FMI_EXPORT fmi2GetIntegerTYPE fmi2GetInteger;
FMI_EXPORT fmi2GetBooleanTYPE fmi2GetBoolean;
FMI_EXPORT fmi2GetStringTYPE fmi2GetString;
FMI_EXPORT fmi2SetRealTYPE fmi2SetReal;
FMI_EXPORT fmi2SetIntegerTYPE fmi2SetInteger;
FMI_EXPORT fmi2SetBooleanTYPE fmi2SetBoolean;
FMI_EXPORT fmi2SetStringTYPE fmi2SetString;
FMI_EXPORT fmi2GetFMUstateTYPE fmi2GetFMUstate;
FMI_EXPORT fmi2SetFMUstateTYPE fmi2SetFMUstate;
FMI_EXPORT fmi2FreeFMUstateTYPE fmi2FreeFMUstate;
FMI_EXPORT fmi2SerializedFMUstateSizeTYPE fmi2SerializedFMUstateSize;
FMI_EXPORT fmi2SerializeFMUstateTYPE fmi2SerializeFMUstate;
FMI_EXPORT fmi2DeSerializeFMUstateTYPE fmi2DeSerializeFMUstate;
FMI_EXPORT fmi2GetDirectionalDerivativeTYPE fmi2GetDirectionalDerivative;
FMI_EXPORT fmi2EnterEventModeTYPE fmi2EnterEventMode;
FMI_EXPORT fmi2NewDiscreteStatesTYPE fmi2NewDiscreteStates;
FMI_EXPORT fmi2EnterContinuousTimeModeTYPE fmi2EnterContinuousTimeMode;
FMI_EXPORT fmi2CompletedIntegratorStepTYPE fmi2CompletedIntegratorStep;
FMI_EXPORT fmi2SetTimeTYPE fmi2SetTime;
FMI_EXPORT fmi2SetContinuousStatesTYPE fmi2SetContinuousStates;
FMI_EXPORT fmi2GetDerivativesTYPE fmi2GetDerivatives;
FMI_EXPORT fmi2GetEventIndicatorsTYPE fmi2GetEventIndicators;
FMI_EXPORT fmi2GetContinuousStatesTYPE fmi2GetContinuousStates;
FMI_EXPORT fmi2GetNominalsOfContinuousStatesTYPE fmi2GetNominalsOfContinuousStates;
FMI_EXPORT fmi2SetRealInputDerivativesTYPE fmi2SetRealInputDerivatives;
FMI_EXPORT fmi2GetRealOutputDerivativesTYPE fmi2GetRealOutputDerivatives;
FMI_EXPORT fmi2DoStepTYPE fmi2DoStep;
FMI_EXPORT fmi2CancelStepTYPE fmi2CancelStep;
FMI_EXPORT fmi2GetStatusTYPE fmi2GetStatus;
FMI_EXPORT fmi2GetRealStatusTYPE fmi2GetRealStatus;
FMI_EXPORT fmi2GetIntegerStatusTYPE fmi2GetIntegerStatus;
FMI_EXPORT fmi2GetBooleanStatusTYPE fmi2GetBooleanStatus;
FMI_EXPORT fmi2GetStringStatusTYPE fmi2GetStringStatus;

#ifdef __cplusplus
}
#endif
#endif
