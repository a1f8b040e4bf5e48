// What a step costs inside an FMU, and what it costs in a program (bench/fmu_cost.py). All steps
// are made inside one function of a fixed name, floatframe_counted_steps, where callgrind counts.
//
//   step_costs fmu LIBRARY RESOURCES TOKEN STEP COUNT   doStep of FMI 2.0
//   step_costs program MODEL.ffm COUNT                  Simulation::step of the same packed model
//   step_costs times LIBRARY RESOURCES TOKEN STEP COUNT MODEL.ffm
//
// Prints a line per figure, NAME VALUE; times are the least of several, in seconds.
#include <dlfcn.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <limits>
#include <span>
#include <string>
#include <vector>

#define FMI_EXPORT extern
#include "floatframe/packed/packed_model.hpp"
#include "floatframe/simulation.hpp"
#include "fmi/fmi2_standard.h"

namespace {

using Step = std::function<bool()>;

[[noreturn]] void fail(const std::string& why) {
  std::fprintf(stderr, "step_costs: %s\n", why.c_str());
  std::exit(1);
}

void must(bool is_done, const char* what) {
  if (!is_done) fail(std::string(what) + " has failed");
}

void hear(fmi2ComponentEnvironment, fmi2String, fmi2Status, fmi2String category, fmi2String message,
          ...) {
  std::fprintf(stderr, "[%s] %s\n", category, message);
}
constexpr fmi2CallbackFunctions importer = {hear, std::calloc, std::free, nullptr, nullptr};

template <class Function>
Function* find(void* library, const char* name) {
  void* const found = dlsym(library, name);
  if (found == nullptr) fail(std::string("the library has no function ") + name);
  return reinterpret_cast<Function*>(found);
}

/// An instance by the functions that a library has.
class Fmu {
 public:
  Fmu(const char* library, const char* resources, const char* token, double step)
      : resources_(resources), token_(token), step_(step) {
    library_ = dlopen(library, RTLD_NOW | RTLD_LOCAL);
    if (library_ == nullptr) fail(dlerror());
    do_step_ = find<fmi2DoStepTYPE>(library_, "fmi2DoStep");
  }
  ~Fmu() { release(); }
  Fmu(const Fmu&) = delete;
  Fmu& operator=(const Fmu&) = delete;

  void create() {
    release();
    made_ = find<fmi2InstantiateTYPE>(library_, "fmi2Instantiate")(
        "counted", fmi2CoSimulation, token_, resources_, &importer, fmi2False, fmi2False);
    must(made_ != nullptr, "fmi2Instantiate");
    at_ = 0;
  }
  void start() {
    must(find<fmi2SetupExperimentTYPE>(library_, "fmi2SetupExperiment")(made_, fmi2False, 0.0, 0.0,
                                                                        fmi2False, 0.0) == fmi2OK,
         "fmi2SetupExperiment");
    must(call("fmi2EnterInitializationMode") == fmi2OK, "fmi2EnterInitializationMode");
    must(call("fmi2ExitInitializationMode") == fmi2OK, "fmi2ExitInitializationMode");
  }
  bool step() { return do_step_(made_, double(at_++) * step_, step_, fmi2True) == fmi2OK; }

 private:
  fmi2Status call(const char* name) {
    return find<fmi2Status(fmi2Component)>(library_, name)(made_);
  }
  void release() {
    if (made_ != nullptr) find<fmi2FreeInstanceTYPE>(library_, "fmi2FreeInstance")(made_);
    made_ = nullptr;
  }

  const char *resources_, *token_;
  double step_;
  long at_ = 0;
  void* library_ = nullptr;
  fmi2DoStepTYPE* do_step_ = nullptr;
  fmi2Component made_ = nullptr;
};

std::vector<std::byte> bytes_of(const char* path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) fail(std::string("cannot read ") + path);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Least of `repeat` times [s].
double least(int repeat, const std::function<void()>& work) {
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeat; ++k) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    best = std::min(best, taken.count());
  }
  return best;
}

}  // namespace

extern "C" [[gnu::noinline]] bool floatframe_counted_steps(const Step* step, long count) {
  bool is_good = true;
  for (long k = 0; k < count; ++k) is_good = (*step)() && is_good;
  return is_good;
}

namespace {

void count_steps(const Step& step, long count) {
  must(floatframe_counted_steps(&step, count), "a step");
}

void print_times(Fmu& fmu, long count, const char* model) {
  const std::vector<std::byte> bytes = bytes_of(model);
  const floatframe::PackedModel packed = floatframe::PackedModel::from_bytes(bytes);
  std::printf("read %.6g\n", least(20, [&] { floatframe::PackedModel::from_bytes(bytes); }));
  std::printf("describe %.6g\n", least(20, [&] { packed.description(); }));
  std::printf("build %.6g\n", least(20, [&] { packed.build(); }));
  std::printf("create %.6g\n", least(20, [&] { fmu.create(); }));
  double start = std::numeric_limits<double>::infinity(), steps = start;
  const Step step = [&] { return fmu.step(); };
  for (int k = 0; k < 5; ++k) {
    fmu.create();
    start = std::min(start, least(1, [&] { fmu.start(); }));
    steps = std::min(steps, least(1, [&] { count_steps(step, count); }));
  }
  std::printf("start %.6g\nstep %.6g\n", start, steps / double(count));
}

int run(std::span<char*> words) {
  const std::string kind = words.size() > 1 ? words[1] : "";
  if (kind == "program" && words.size() == 4) {
    const floatframe::Model model = floatframe::PackedModel::from_bytes(bytes_of(words[2])).build();
    floatframe::Simulation simulation(model);
    count_steps([&] { return bool(simulation.step()); }, std::atol(words[3]));
    return 0;
  }
  if (!(kind == "fmu" && words.size() == 7) && !(kind == "times" && words.size() == 8))
    fail("found other words than those in the head of this file");
  Fmu fmu(words[2], words[3], words[4], std::atof(words[5]));
  if (kind == "times") {
    print_times(fmu, std::atol(words[6]), words[7]);
    return 0;
  }
  fmu.create();
  fmu.start();
  count_steps([&] { return fmu.step(); }, std::atol(words[6]));
  return 0;
}

}  // namespace

int main(int count, char** words) {
  try {
    return run({words, static_cast<std::size_t>(count)});
  } catch (const std::exception& error) {
    fail(error.what());
  }
}
