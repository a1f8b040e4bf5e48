/* A master for co-simulation in C99, from the declarations of the standard and the loader of the
 * system alone. It runs the FMU of an unzipped folder and prints its outputs, with all digits:
 *
 *   master LIBRARY RESOURCES TOKEN STOP STEP COUNT [options]
 *     LIBRARY    binaries/linux64/vehicle.so, ...
 *     RESOURCES  for FMI 2 a URI, for FMI 3 a path
 *     TOKEN      guid or instantiationToken of modelDescription.xml
 *     COUNT      of outputs, the value references of which begin at 0x20000
 *   --set REFERENCE=VALUE  before the initialization (parameters) or a value of an input, as often as wanted
 *   --save TIME=FILE       serialises the state at the first point from TIME on, and goes on
 *   --load FILE            goes on from there; the first line is that of its time
 *   --again TIME           keeps the state at TIME, makes a step, returns and makes it again
 *   --threads N            N instances, one thread each; prints those of the first, which all must equal
 *
 * Each line: time, outputs. Exit code 1: a call has failed; what and where is on stderr.
 * Linux: cc -std=c99 -o master master.c -ldl -lpthread. Windows: x86_64-w64-mingw32-gcc -o master.exe master.c. */
#define FMI_EXPORT extern
#ifndef _WIN32
#define _POSIX_C_SOURCE 200809L
#endif
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fmi/fmi2_standard.h"
#include "fmi/fmi3_standard.h"

#ifdef _WIN32
#include <windows.h>
static void* load(const char* file) { return (void*)LoadLibraryA(file); }
static void find(void* library, const char* name, void* to) {
  FARPROC found = GetProcAddress((HMODULE)library, name);
  memcpy(to, &found, sizeof found);
}
#else
#include <dlfcn.h>
#include <pthread.h>
static void* load(const char* file) {
  void* library = dlopen(file, RTLD_NOW | RTLD_LOCAL);
  if (!library) fprintf(stderr, "%s\n", dlerror());
  return library;
}
static void find(void* library, const char* name, void* to) {
  void* found = dlsym(library, name);
  memcpy(to, &found, sizeof found);
}
#endif

#define FIND(type, name)                                                   \
  static type##TYPE* name(void* library) {                                 \
    type##TYPE* found = NULL;                                              \
    find(library, #type, &found);                                          \
    if (!found) {                                                          \
      fprintf(stderr, "the library has no function %s\n", #type);          \
      exit(1);                                                             \
    }                                                                      \
    return found;                                                          \
  }
FIND(fmi2Instantiate, make2)
FIND(fmi2FreeInstance, free2)
FIND(fmi2SetupExperiment, set_up2)
FIND(fmi2EnterInitializationMode, enter2)
FIND(fmi2ExitInitializationMode, exit2)
FIND(fmi2GetReal, get2)
FIND(fmi2SetReal, set2)
FIND(fmi2DoStep, step2)
FIND(fmi2Terminate, terminate2)
FIND(fmi2GetFMUstate, get_state2)
FIND(fmi2SetFMUstate, set_state2)
FIND(fmi2FreeFMUstate, free_state2)
FIND(fmi2SerializedFMUstateSize, size2)
FIND(fmi2SerializeFMUstate, write2)
FIND(fmi2DeSerializeFMUstate, read2)
FIND(fmi3InstantiateCoSimulation, make3)
FIND(fmi3FreeInstance, free3)
FIND(fmi3EnterInitializationMode, enter3)
FIND(fmi3ExitInitializationMode, exit3)
FIND(fmi3GetFloat64, get3)
FIND(fmi3SetFloat64, set3)
FIND(fmi3DoStep, step3)
FIND(fmi3Terminate, terminate3)
FIND(fmi3GetFMUState, get_state3)
FIND(fmi3SetFMUState, set_state3)
FIND(fmi3FreeFMUState, free_state3)
FIND(fmi3SerializedFMUStateSize, size3)
FIND(fmi3SerializeFMUState, write3)
FIND(fmi3DeserializeFMUState, read3)

enum { MOST = 64, MOST_OUTPUTS = 4096 };

typedef struct {
  const char *library, *resources, *token;
  double stop, step;
  size_t count;
  int set_count;
  unsigned references[MOST];
  double values[MOST];
  double save_at, again_at;
  const char *save_to, *load_from;
  int threads;
} Task;

typedef struct {
  const Task* task;
  void *library, *c;
  int version;
  FILE* out; /* NULL: keeps the last outputs only */
  double last[MOST_OUTPUTS];
} Master;

static void hear2(fmi2ComponentEnvironment e, fmi2String name, fmi2Status status, fmi2String category, fmi2String message, ...) {
  (void)e;
  fprintf(stderr, "%s [%s, %d] %s\n", name, category, (int)status, message);
}
static void hear3(fmi3InstanceEnvironment e, fmi3Status status, fmi3String category, fmi3String message) {
  (void)e;
  fprintf(stderr, "[%s, %d] %s\n", category, (int)status, message);
}

static void must(int status, const char* what, double time) {
  if (status <= 1) return; /* ok or warning */
  fprintf(stderr, "%s at %.17g s: status %d\n", what, time, status);
  exit(1);
}

#define CALL(m, name, ...) ((m)->version == 2 ? (int)name##2((m)->library)(__VA_ARGS__) : (int)name##3((m)->library)(__VA_ARGS__))

static void begin(Master* m) {
  const Task* t = m->task;
  static const fmi2CallbackFunctions importer = {hear2, NULL, NULL, NULL, NULL};
  void* version = NULL;
  m->library = load(t->library);
  if (!m->library) exit(1);
  find(m->library, "fmi3GetVersion", &version);
  /* One library may have both: the resources decide, a URI for FMI 2. */
  m->version = strncmp(t->resources, "file:", 5) == 0 || !version ? 2 : 3;
  m->c = m->version == 2 ? make2(m->library)("vehicle", fmi2CoSimulation, t->token, t->resources, &importer, fmi2False, fmi2False)
                         : make3(m->library)("vehicle", t->token, t->resources, false, true, false, false, NULL, 0, NULL, hear3, NULL);
  if (!m->c) exit(1);
}

static void initialize(Master* m) {
  const Task* t = m->task;
  int k;
  if (m->version == 2) {
    must(set_up2(m->library)(m->c, 0, 0.0, 0.0, 1, t->stop), "set up", 0.0);
    must(enter2(m->library)(m->c), "enter", 0.0);
  } else {
    must(enter3(m->library)(m->c, false, 0.0, 0.0, true, t->stop), "enter", 0.0);
  }
  for (k = 0; k < t->set_count; ++k)
    must(m->version == 2 ? (int)set2(m->library)(m->c, &t->references[k], 1, &t->values[k])
                         : (int)set3(m->library)(m->c, &t->references[k], 1, &t->values[k], 1), "set", 0.0);
  must(CALL(m, exit, m->c), "exit", 0.0);
}

static void look(Master* m, double time) {
  unsigned references[MOST_OUTPUTS];
  size_t k;
  for (k = 0; k < m->task->count; ++k) references[k] = 0x20000u + (unsigned)k;
  must(m->version == 2 ? (int)get2(m->library)(m->c, references, m->task->count, m->last)
                       : (int)get3(m->library)(m->c, references, m->task->count, m->last, m->task->count), "get", time);
  if (!m->out) return;
  fprintf(m->out, "%.17g", time);
  for (k = 0; k < m->task->count; ++k) fprintf(m->out, ",%.17g", m->last[k]);
  fputc('\n', m->out);
}

static void step(Master* m, double time) {
  if (m->version == 2) {
    must(step2(m->library)(m->c, time, m->task->step, fmi2True), "step", time);
  } else {
    bool event = false, terminate = false, early = false;
    double last = time;
    must(step3(m->library)(m->c, time, m->task->step, true, &event, &terminate, &early, &last), "step", time);
  }
}

static void save(Master* m, long done) {
  const double steps = (double)done; /* of one size on all systems */
  void* state = NULL;
  size_t size = 0;
  unsigned char* bytes;
  FILE* file = fopen(m->task->save_to, "wb");
  must(CALL(m, get_state, m->c, &state), "get state", 0.0);
  must(CALL(m, size, m->c, state, &size), "size", 0.0);
  bytes = malloc(size);
  must(!bytes || !file ? 3 : m->version == 2 ? (int)write2(m->library)(m->c, state, (fmi2Byte*)bytes, size)
                                             : (int)write3(m->library)(m->c, state, bytes, size), "write", 0.0);
  fwrite(&steps, sizeof steps, 1, file);
  fwrite(bytes, 1, size, file);
  fclose(file);
  free(bytes);
  must(CALL(m, free_state, m->c, &state), "free state", 0.0);
}

static long restore(Master* m) {
  FILE* file = fopen(m->task->load_from, "rb");
  unsigned char* bytes;
  size_t size;
  double steps = 0.0;
  void* state = NULL;
  must(file ? 0 : 3, "open the state", 0.0);
  fseek(file, 0, SEEK_END);
  size = (size_t)ftell(file) - sizeof steps;
  rewind(file);
  bytes = malloc(size);
  must(bytes && fread(&steps, sizeof steps, 1, file) == 1 && fread(bytes, 1, size, file) == size ? 0 : 3, "load", 0.0);
  fclose(file);
  must(m->version == 2 ? (int)read2(m->library)(m->c, (fmi2Byte*)bytes, size, &state)
                       : (int)read3(m->library)(m->c, bytes, size, &state), "read", 0.0);
  must(CALL(m, set_state, m->c, state), "set state", 0.0);
  must(CALL(m, free_state, m->c, &state), "free state", 0.0);
  free(bytes);
  return (long)steps;
}

static void again(Master* m, double time) {
  void* state = NULL;
  must(CALL(m, get_state, m->c, &state), "get state", time);
  step(m, time);
  must(CALL(m, set_state, m->c, state), "set state", time);
  must(CALL(m, free_state, m->c, &state), "free state", time);
}

static void run(Master* m) {
  const Task* t = m->task;
  const long steps = (long)(t->stop / t->step + 0.5);
  long k = 0;
  int saved = 0, repeated = 0;
  begin(m);
  if (t->load_from)
    k = restore(m);
  else
    initialize(m);
  look(m, (double)k * t->step);
  for (; k < steps; ++k) {
    const double time = (double)k * t->step;
    if (t->save_to && !saved && time >= t->save_at) {
      save(m, k);
      saved = 1;
    }
    if (t->again_at >= 0.0 && !repeated && time >= t->again_at) {
      again(m, time);
      repeated = 1;
    }
    step(m, time);
    look(m, (double)(k + 1) * t->step);
  }
  must(CALL(m, terminate, m->c), "terminate", t->stop);
  if (m->version == 2)
    free2(m->library)(m->c);
  else
    free3(m->library)(m->c);
}

#ifdef _WIN32
typedef HANDLE Thread;
static DWORD WINAPI run_thread(LPVOID master) {
  run((Master*)master);
  return 0;
}
static Thread start(Master* m) { return CreateThread(NULL, 0, run_thread, m, 0, NULL); }
static void join(Thread thread) { WaitForSingleObject(thread, INFINITE); }
#else
typedef pthread_t Thread;
static void* run_thread(void* master) {
  run((Master*)master);
  return NULL;
}
static Thread start(Master* m) {
  pthread_t thread;
  if (pthread_create(&thread, NULL, run_thread, m) != 0) exit(1);
  return thread;
}
static void join(Thread thread) { pthread_join(thread, NULL); }
#endif

static void run_in_threads(const Task* task) {
  Thread threads[MOST];
  Master* masters = calloc((size_t)task->threads, sizeof *masters);
  int k;
  if (!masters) exit(1);
  for (k = 0; k < task->threads; ++k) {
    masters[k].task = task;
    masters[k].out = k == 0 ? stdout : NULL;
    threads[k] = start(&masters[k]);
  }
  for (k = 0; k < task->threads; ++k) join(threads[k]);
  for (k = 1; k < task->threads; ++k)
    must(memcmp(masters[k].last, masters[0].last, sizeof masters[0].last) == 0 ? 0 : 3, "threads differ", task->stop);
  free(masters);
}

static void read_options(Task* task, int count, char** words) {
  int k;
  for (k = 0; k + 1 < count; k += 2) {
    char* const value = words[k + 1];
    char* const equals = strchr(value, '=');
    if (strcmp(words[k], "--set") == 0 && equals && task->set_count < MOST) {
      task->references[task->set_count] = (unsigned)strtoul(value, NULL, 0);
      task->values[task->set_count++] = strtod(equals + 1, NULL);
    } else if (strcmp(words[k], "--save") == 0 && equals) {
      task->save_at = strtod(value, NULL);
      task->save_to = equals + 1;
    } else if (strcmp(words[k], "--load") == 0) {
      task->load_from = value;
    } else if (strcmp(words[k], "--again") == 0) {
      task->again_at = strtod(value, NULL);
    } else if (strcmp(words[k], "--threads") == 0) {
      task->threads = atoi(value);
    } else {
      fprintf(stderr, "found '%s %s', expected an option\n", words[k], value);
      exit(1);
    }
  }
}

int main(int count, char** words) {
  Task task = {0};
  if (count < 7) {
    fprintf(stderr, "master LIBRARY RESOURCES TOKEN STOP STEP COUNT [options]\n");
    return 1;
  }
  task.library = words[1];
  task.resources = words[2];
  task.token = words[3];
  task.stop = strtod(words[4], NULL);
  task.step = strtod(words[5], NULL);
  task.count = (size_t)strtoul(words[6], NULL, 10);
  task.again_at = -1.0;
  task.threads = 1;
  read_options(&task, count - 7, words + 7);
  if (task.count > MOST_OUTPUTS || task.threads < 1 || task.threads > MOST || !(task.step > 0.0)) return 1;
  run_in_threads(&task);
  return 0;
}
