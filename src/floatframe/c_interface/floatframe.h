/* The C interface of Floatframe: a model, one step at a time. C99, for any language that calls C
 * (docs/c-interface.md of the source).
 *
 *   char text[512];
 *   floatframe_simulation* s = floatframe_open("vehicle.yaml", text, sizeof text);
 *   if (s == NULL || floatframe_start(s) != FLOATFRAME_OK) ...   (text, floatframe_message(s))
 *   while (floatframe_time(s) < 8.0) {
 *     floatframe_set_input(s, 0, 300.0);
 *     if (floatframe_step(s) != FLOATFRAME_OK) break;
 *     z = floatframe_outputs(s)[3];
 *   }
 *   floatframe_close(s);
 *
 * A handle belongs to one thread at a time; several threads may use different handles at once. No
 * function throws, prints or ends the process. Steps, inputs, outputs, the time and the searches by
 * name do not allocate once the simulation has started.
 *
 * Each function that takes a handle accepts NULL and then does nothing: a status is
 * FLOATFRAME_INVALID, a number NaN, a count 0, a search -1, a name or an array NULL, any other text
 * empty. Texts are UTF-8 and belong to the handle, until it is closed; a message is valid until the
 * next call, notes until the next start, reset or restore. Indices count from 0. Units are those of
 * the model. */
#ifndef FLOATFRAME_H
#define FLOATFRAME_H

#include <stddef.h>
#include <stdint.h>

/* FLOATFRAME_STATIC: the functions are linked into the program, not taken from a library. */
#ifndef FLOATFRAME_API
#if defined(_WIN32) && !defined(FLOATFRAME_STATIC)
#ifdef FLOATFRAME_BUILD
#define FLOATFRAME_API __declspec(dllexport)
#else
#define FLOATFRAME_API __declspec(dllimport)
#endif
#elif defined(__GNUC__)
#define FLOATFRAME_API __attribute__((visibility("default")))
#else
#define FLOATFRAME_API
#endif
#endif

#ifdef __cplusplus
#define FLOATFRAME_NOEXCEPT noexcept
extern "C" {
#else
#define FLOATFRAME_NOEXCEPT
#endif

/** Grows when a function is added; functions that exist keep their meaning. */
#define FLOATFRAME_INTERFACE_VERSION 1

/** A model with its options, parameters, inputs and, after the start, its motion. */
typedef struct floatframe_simulation floatframe_simulation;

/** What came of a call. From FLOATFRAME_WARNING on `floatframe_message` says more. */
typedef enum floatframe_status {
  FLOATFRAME_OK = 0,
  /** Done, but not as asked: an input was replaced by its nearer limit. */
  FLOATFRAME_WARNING = 1,
  /** A wrong argument, value or file; nothing has changed. */
  FLOATFRAME_INVALID = 2,
  /** Not possible now, as a step before the start; nothing has changed. */
  FLOATFRAME_WRONG_ORDER = 3,
  /** No start state was found: loops do not close, there is no equilibrium. Nothing has changed. */
  FLOATFRAME_NO_START = 4,
  /** Time and outputs are those before the step. Further steps fail until a saved state is restored
   * or the start is renewed. */
  FLOATFRAME_STEP_FAILED = 5,
  /** Nothing has changed, unless a step has failed. */
  FLOATFRAME_OUT_OF_MEMORY = 6,
  /** An error of Floatframe; please report it. */
  FLOATFRAME_INTERNAL = 7
} floatframe_status;

/** FLOATFRAME_INTERFACE_VERSION of the library. */
FLOATFRAME_API int32_t floatframe_interface_version(void) FLOATFRAME_NOEXCEPT;
/** The version of the library, "0.1.0". */
FLOATFRAME_API const char* floatframe_version(void) FLOATFRAME_NOEXCEPT;

/* ---- opening and closing ---- */

/** Opens a model file (YAML) or a packed model (.ffm). NULL: `message` says why, as far as `size`
 * bytes reach; it may be NULL, and ends with 0. The options and inputs are those of the model. */
FLOATFRAME_API floatframe_simulation* floatframe_open(const char* path, char* message,
                                                      size_t size) FLOATFRAME_NOEXCEPT;
/** Opens the content of a packed model, which is copied. A model file as text is not taken. */
FLOATFRAME_API floatframe_simulation* floatframe_open_memory(const void* bytes, size_t count,
                                                             char* message,
                                                             size_t size) FLOATFRAME_NOEXCEPT;
/** Ends a handle, and all its texts and arrays. */
FLOATFRAME_API void floatframe_close(floatframe_simulation*) FLOATFRAME_NOEXCEPT;

/** Says what was wrong with the last call whose status was not FLOATFRAME_OK: one sentence or
 * several lines of them. Empty before. */
FLOATFRAME_API const char* floatframe_message(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** The name of the model. */
FLOATFRAME_API const char* floatframe_model_name(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** The checksum of a packed model in hexadecimal digits; empty for a model file. */
FLOATFRAME_API const char* floatframe_fingerprint(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;

/* ---- options and start ---- */

/** Sets an option, before the start: "step", "coordinates", "inertia", "start", "tolerance", ...
 * Keys, words and numbers are those of `simulation` in model files. */
FLOATFRAME_API floatframe_status floatframe_set_option(floatframe_simulation*, const char* key,
                                                       const char* value) FLOATFRAME_NOEXCEPT;

/** Finds the start with the present options, parameters and inputs: loops closed, or the
 * equilibrium. Again: returns to the start; inputs and parameters keep their values. */
FLOATFRAME_API floatframe_status floatframe_start(floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** Goes back to before the start, keeping options, parameters and inputs: all of them can be set
 * again, also those that hold for a whole run, as the step. */
FLOATFRAME_API floatframe_status floatframe_reset(floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** The number of notes about the start: what was changed, what is not unique. */
FLOATFRAME_API int32_t floatframe_note_count(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** A note about the start, a sentence. */
FLOATFRAME_API const char* floatframe_note(const floatframe_simulation*,
                                           int32_t index) FLOATFRAME_NOEXCEPT;

/* ---- steps ---- */

/** The end of the last step [s]; NaN before the start. */
FLOATFRAME_API double floatframe_time(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** The size of `floatframe_step` [s]. */
FLOATFRAME_API double floatframe_step_size(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** Makes one step, in substeps if necessary. */
FLOATFRAME_API floatframe_status floatframe_step(floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** Makes one step of another size, above 0 and up to 1e6 s. Steps of the default size go on from
 * its end. */
FLOATFRAME_API floatframe_status floatframe_step_by(floatframe_simulation*,
                                                    double size) FLOATFRAME_NOEXCEPT;
/** Steps that were made since the start, and restored with a state. */
FLOATFRAME_API int64_t floatframe_step_count(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** Substeps of steps that had to be divided, since the start. */
FLOATFRAME_API int64_t floatframe_substep_count(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** Newton iterations since the start. */
FLOATFRAME_API int64_t floatframe_iteration_count(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;

/* ---- inputs: constant over the next step and later ones ---- */

FLOATFRAME_API int32_t floatframe_input_count(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** NULL: no such index. */
FLOATFRAME_API const char* floatframe_input_name(const floatframe_simulation*,
                                                 int32_t index) FLOATFRAME_NOEXCEPT;
/** NULL: no such index. */
FLOATFRAME_API const char* floatframe_input_unit(const floatframe_simulation*,
                                                 int32_t index) FLOATFRAME_NOEXCEPT;
/** The value of the model; NaN: no such index. */
FLOATFRAME_API double floatframe_input_initial(const floatframe_simulation*,
                                               int32_t index) FLOATFRAME_NOEXCEPT;
/** The lower limit; -infinity: none. NaN: no such index. */
FLOATFRAME_API double floatframe_input_low(const floatframe_simulation*,
                                           int32_t index) FLOATFRAME_NOEXCEPT;
/** The upper limit; infinity: none. NaN: no such index. */
FLOATFRAME_API double floatframe_input_high(const floatframe_simulation*,
                                            int32_t index) FLOATFRAME_NOEXCEPT;
/** The index of an input; -1: none of this name. */
FLOATFRAME_API int32_t floatframe_find_input(const floatframe_simulation*,
                                             const char* name) FLOATFRAME_NOEXCEPT;
/** The present value; NaN: no such index. */
FLOATFRAME_API double floatframe_input(const floatframe_simulation*,
                                       int32_t index) FLOATFRAME_NOEXCEPT;
/** Sets an input, before the start too. FLOATFRAME_INVALID: not finite or outside of the limits; of
 * an input with `clamp` the nearer limit is taken, with FLOATFRAME_WARNING. */
FLOATFRAME_API floatframe_status floatframe_set_input(floatframe_simulation*, int32_t index,
                                                      double value) FLOATFRAME_NOEXCEPT;

/* ---- outputs: at the end of the last step ---- */

FLOATFRAME_API int32_t floatframe_output_count(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** NULL: no such index. */
FLOATFRAME_API const char* floatframe_output_name(const floatframe_simulation*,
                                                  int32_t index) FLOATFRAME_NOEXCEPT;
/** NULL: no such index. */
FLOATFRAME_API const char* floatframe_output_unit(const floatframe_simulation*,
                                                  int32_t index) FLOATFRAME_NOEXCEPT;
/** The index of an output; -1: none of this name. */
FLOATFRAME_API int32_t floatframe_find_output(const floatframe_simulation*,
                                              const char* name) FLOATFRAME_NOEXCEPT;
/** NaN: no such index, or not started. */
FLOATFRAME_API double floatframe_output(const floatframe_simulation*,
                                        int32_t index) FLOATFRAME_NOEXCEPT;
/** All outputs in their order; NaN before the start. The array stays where it is until the handle
 * is closed, and takes the new values after each step. */
FLOATFRAME_API const double* floatframe_outputs(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;

/* ---- parameters: of a packed model, what takes a new value without a build ---- */

FLOATFRAME_API int32_t floatframe_parameter_count(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** NULL: no such index. */
FLOATFRAME_API const char* floatframe_parameter_name(const floatframe_simulation*,
                                                     int32_t index) FLOATFRAME_NOEXCEPT;
/** NULL: no such index. */
FLOATFRAME_API const char* floatframe_parameter_unit(const floatframe_simulation*,
                                                     int32_t index) FLOATFRAME_NOEXCEPT;
/** What it is, as the model file says. NULL: no such index. */
FLOATFRAME_API const char* floatframe_parameter_about(const floatframe_simulation*,
                                                      int32_t index) FLOATFRAME_NOEXCEPT;
/** The index of a parameter; -1: none of this name. */
FLOATFRAME_API int32_t floatframe_find_parameter(const floatframe_simulation*,
                                                 const char* name) FLOATFRAME_NOEXCEPT;
/** The present value; NaN: no such index. */
FLOATFRAME_API double floatframe_parameter(const floatframe_simulation*,
                                           int32_t index) FLOATFRAME_NOEXCEPT;
/** Sets a parameter. Before the start, or followed by a new one, the start is found with it, and
 * says if the value is no good; limits of inputs, initial values of those that were not set and the
 * step follow before the start. Otherwise it acts from the next step on: the call builds the model
 * again, and allocates. FLOATFRAME_INVALID for one that holds for a whole run, as the step:
 * floatframe_reset comes before it. */
FLOATFRAME_API floatframe_status floatframe_set_parameter(floatframe_simulation*, int32_t index,
                                                          double value) FLOATFRAME_NOEXCEPT;
/** Sets several at once, or none: the model is built once. */
FLOATFRAME_API floatframe_status floatframe_set_parameters(floatframe_simulation*,
                                                           const int32_t* indices,
                                                           const double* values,
                                                           size_t count) FLOATFRAME_NOEXCEPT;

/* ---- saved states ---- */

/** Saves everything that determines the next steps, parameters and inputs included, and keeps it in
 * the handle. `count`, which may be NULL: its size [byte]. */
FLOATFRAME_API floatframe_status floatframe_save(floatframe_simulation*,
                                                 size_t* count) FLOATFRAME_NOEXCEPT;
/** The bytes of the last save, until the next one; NULL: none. */
FLOATFRAME_API const void* floatframe_saved(const floatframe_simulation*) FLOATFRAME_NOEXCEPT;
/** Returns to a saved state, of this process or another, of the same model with the same options:
 * the next steps have equal bits. Before the start it takes the place of the start. */
FLOATFRAME_API floatframe_status floatframe_restore(floatframe_simulation*, const void* bytes,
                                                    size_t count) FLOATFRAME_NOEXCEPT;

#ifdef __cplusplus
}
#endif
#endif
