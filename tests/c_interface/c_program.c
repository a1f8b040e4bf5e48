/* Every function of floatframe.h from C99: what is asked of the arguments, in which order calls come.
 * Usage: c_program MODEL OUTPUT, with an output of the model. */
#include <floatframe.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int failures = 0;

#define EXPECT(condition)                                                       \
  do {                                                                          \
    if (!(condition)) {                                                         \
      ++failures;                                                               \
      printf("%s:%d: expected %s\n", __FILE__, __LINE__, #condition);           \
    }                                                                           \
  } while (0)

/* Nothing may come of NULL. */
static void without_a_handle(void) {
  const int32_t index = 0;
  const double value = 0.0;
  size_t count = 7;
  floatframe_close(NULL);
  EXPECT(strcmp(floatframe_message(NULL), "") == 0);
  EXPECT(strcmp(floatframe_model_name(NULL), "") == 0);
  EXPECT(strcmp(floatframe_fingerprint(NULL), "") == 0);
  EXPECT(floatframe_set_option(NULL, "step", "1") == FLOATFRAME_INVALID);
  EXPECT(floatframe_start(NULL) == FLOATFRAME_INVALID);
  EXPECT(floatframe_reset(NULL) == FLOATFRAME_INVALID);
  EXPECT(floatframe_note_count(NULL) == 0);
  EXPECT(floatframe_note(NULL, 0) == NULL);
  EXPECT(isnan(floatframe_time(NULL)));
  EXPECT(isnan(floatframe_step_size(NULL)));
  EXPECT(floatframe_step(NULL) == FLOATFRAME_INVALID);
  EXPECT(floatframe_step_by(NULL, 1.0) == FLOATFRAME_INVALID);
  EXPECT(floatframe_step_count(NULL) == 0);
  EXPECT(floatframe_substep_count(NULL) == 0);
  EXPECT(floatframe_iteration_count(NULL) == 0);
  EXPECT(floatframe_input_count(NULL) == 0);
  EXPECT(floatframe_input_name(NULL, 0) == NULL);
  EXPECT(floatframe_input_unit(NULL, 0) == NULL);
  EXPECT(isnan(floatframe_input_initial(NULL, 0)));
  EXPECT(isnan(floatframe_input_low(NULL, 0)));
  EXPECT(isnan(floatframe_input_high(NULL, 0)));
  EXPECT(floatframe_find_input(NULL, "x") == -1);
  EXPECT(isnan(floatframe_input(NULL, 0)));
  EXPECT(floatframe_set_input(NULL, 0, 1.0) == FLOATFRAME_INVALID);
  EXPECT(floatframe_output_count(NULL) == 0);
  EXPECT(floatframe_output_name(NULL, 0) == NULL);
  EXPECT(floatframe_output_unit(NULL, 0) == NULL);
  EXPECT(floatframe_find_output(NULL, "x") == -1);
  EXPECT(isnan(floatframe_output(NULL, 0)));
  EXPECT(floatframe_outputs(NULL) == NULL);
  EXPECT(floatframe_parameter_count(NULL) == 0);
  EXPECT(floatframe_parameter_name(NULL, 0) == NULL);
  EXPECT(floatframe_parameter_unit(NULL, 0) == NULL);
  EXPECT(floatframe_parameter_about(NULL, 0) == NULL);
  EXPECT(floatframe_find_parameter(NULL, "x") == -1);
  EXPECT(isnan(floatframe_parameter(NULL, 0)));
  EXPECT(floatframe_set_parameter(NULL, 0, 1.0) == FLOATFRAME_INVALID);
  EXPECT(floatframe_set_parameters(NULL, &index, &value, 1) == FLOATFRAME_INVALID);
  EXPECT(floatframe_save(NULL, &count) == FLOATFRAME_INVALID && count == 0);
  EXPECT(floatframe_save(NULL, NULL) == FLOATFRAME_INVALID);
  EXPECT(floatframe_saved(NULL) == NULL);
  EXPECT(floatframe_restore(NULL, "x", 1) == FLOATFRAME_INVALID);
}

static void without_a_model(void) {
  char text[12] = "untouched";
  EXPECT(floatframe_open(NULL, text, sizeof text) == NULL);
  EXPECT(strlen(text) == sizeof text - 1); /* as far as it reaches */
  EXPECT(floatframe_open("no/such/model.yaml", NULL, 0) == NULL);
  EXPECT(floatframe_open("no/such/model.yaml", text, 1) == NULL && text[0] == '\0');
  EXPECT(floatframe_open_memory(NULL, 5, text, sizeof text) == NULL);
  EXPECT(floatframe_open_memory("floatframe: 1", 13, text, sizeof text) == NULL);
  EXPECT(floatframe_open_memory("", 0, NULL, 0) == NULL);
}

static void before_the_start(floatframe_simulation* s) {
  EXPECT(isnan(floatframe_time(s)));
  EXPECT(isnan(floatframe_output(s, 0)));
  EXPECT(floatframe_outputs(s) != NULL && isnan(floatframe_outputs(s)[0]));
  EXPECT(floatframe_step(s) == FLOATFRAME_WRONG_ORDER);
  EXPECT(strlen(floatframe_message(s)) > 10);
  EXPECT(floatframe_step_by(s, 0.1) == FLOATFRAME_WRONG_ORDER);
  EXPECT(floatframe_save(s, NULL) == FLOATFRAME_WRONG_ORDER);
  EXPECT(floatframe_saved(s) == NULL);
  EXPECT(floatframe_set_option(s, "stepp", "1") == FLOATFRAME_INVALID);
  EXPECT(strstr(floatframe_message(s), "'step'?") != NULL);
  EXPECT(floatframe_set_option(s, "step", "-1") == FLOATFRAME_INVALID);
  EXPECT(floatframe_set_option(s, NULL, "1") == FLOATFRAME_INVALID);
  EXPECT(floatframe_set_option(s, "step", NULL) == FLOATFRAME_INVALID);
  EXPECT(floatframe_set_option(s, "step", "2e-3") == FLOATFRAME_OK);
  EXPECT(floatframe_step_size(s) == 2e-3);
}

static void steps_and_states(floatframe_simulation* s, int32_t output) {
  const double sizes[] = {0.0, -1.0, 2e6, NAN, INFINITY};
  const double* all = floatframe_outputs(s);
  double* after;
  void* kept;
  size_t count = 0, k;
  const size_t outputs = (size_t)floatframe_output_count(s);
  EXPECT(floatframe_start(s) == FLOATFRAME_OK);
  EXPECT(floatframe_time(s) == 0.0);
  EXPECT(floatframe_set_option(s, "step", "1") == FLOATFRAME_WRONG_ORDER);
  for (k = 0; k < sizeof sizes / sizeof *sizes; ++k)
    EXPECT(floatframe_step_by(s, sizes[k]) == FLOATFRAME_INVALID);
  EXPECT(floatframe_step(s) == FLOATFRAME_OK);
  EXPECT(floatframe_step_by(s, 1e-3) == FLOATFRAME_OK);
  EXPECT(fabs(floatframe_time(s) - 3e-3) < 1e-15);
  EXPECT(floatframe_step_count(s) == 2);
  EXPECT(floatframe_iteration_count(s) >= 2);
  EXPECT(floatframe_outputs(s) == all);
  EXPECT(floatframe_output(s, output) == all[output]);
  EXPECT(isnan(floatframe_output(s, -1)) && isnan(floatframe_output(s, (int32_t)outputs)));

  EXPECT(floatframe_save(s, &count) == FLOATFRAME_OK && count > 100);
  kept = malloc(count);
  after = malloc(outputs * sizeof *after);
  memcpy(kept, floatframe_saved(s), count);
  EXPECT(floatframe_step(s) == FLOATFRAME_OK);
  memcpy(after, all, outputs * sizeof *after);
  EXPECT(floatframe_step(s) == FLOATFRAME_OK);
  EXPECT(memcmp(after, all, outputs * sizeof *after) != 0);
  EXPECT(floatframe_restore(s, kept, count) == FLOATFRAME_OK);
  EXPECT(fabs(floatframe_time(s) - 3e-3) < 1e-15);
  EXPECT(floatframe_step(s) == FLOATFRAME_OK);
  EXPECT(memcmp(after, all, outputs * sizeof *after) == 0);
  EXPECT(floatframe_restore(s, kept, count - 1) == FLOATFRAME_INVALID);
  EXPECT(floatframe_restore(s, NULL, count) == FLOATFRAME_INVALID);
  EXPECT(floatframe_restore(s, "", 0) == FLOATFRAME_INVALID);
  EXPECT(memcmp(after, all, outputs * sizeof *after) == 0);
  free(kept);
  free(after);
}

int main(int argc, char** argv) {
  char text[1000];
  floatframe_simulation* s;
  int32_t output;
  if (argc != 3) return 2;
  EXPECT(floatframe_interface_version() == FLOATFRAME_INTERFACE_VERSION);
  EXPECT(strlen(floatframe_version()) >= 5);
  without_a_handle();
  without_a_model();
  s = floatframe_open(argv[1], text, sizeof text);
  if (s == NULL) {
    printf("%s\n", text);
    return 1;
  }
  output = floatframe_find_output(s, argv[2]);
  EXPECT(output >= 0 && strcmp(floatframe_output_name(s, output), argv[2]) == 0);
  EXPECT(floatframe_find_output(s, "no such output") == -1 && floatframe_find_output(s, NULL) == -1);
  EXPECT(floatframe_find_input(s, "") == -1);
  EXPECT(floatframe_output_unit(s, output) != NULL);
  before_the_start(s);
  steps_and_states(s, output);
  floatframe_close(s);
  printf("%d failures\n", failures);
  return failures > 0;
}
