#include <floatframe.h>
#include <stdio.h>

int main(int argc, char** argv) {
  char text[1000];
  floatframe_simulation* s = floatframe_open(argc > 1 ? argv[1] : "", text, sizeof text);
  if (s == NULL || floatframe_start(s) != FLOATFRAME_OK || floatframe_step(s) != FLOATFRAME_OK) {
    printf("%s %s\n", text, floatframe_message(s));
    return 1;
  }
  printf("%s %s: %g s\n", floatframe_model_name(s), floatframe_version(), floatframe_time(s));
  floatframe_close(s);
  return 0;
}
