#include "fmi/fake_functions.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

#include "fmi/functions.hpp"

struct floatframe_simulation {
  struct State {
    double time = 0.0, x = 0.0, v = 0.0;
    std::array<double, 2> inputs{1.0, 0.0};
    std::array<double, 3> parameters{40.0, 2.0, std::numeric_limits<double>::infinity()};
    std::int64_t failed = 0, steps = 0;
  };
  State state;
  std::array<double, 3> outputs{};
  bool started = false;
  std::string fingerprint, message;
  std::vector<unsigned char> saved;

  floatframe_status say(floatframe_status status, const char* sentence) {
    message = sentence;
    return status;
  }
  void look() { outputs = {state.x, state.v, state.inputs[0] + state.inputs[1]}; }
};

namespace floatframe::testing {
namespace {

std::atomic<int> open{0};
std::atomic<long> steps{0};
std::atomic<double> least_seconds{0.0};
using Fake = floatframe_simulation;

Fake* open_fake(const void* bytes, std::size_t count, char* message, std::size_t size) noexcept {
  if (count < 4 || std::memcmp(bytes, "fake", 4) != 0) {
    if (size > 0) std::strncpy(message, "not a packed model", size - 1);
    return nullptr;
  }
  ++open;
  Fake* const made = new Fake;
  made->fingerprint.assign(static_cast<const char*>(bytes) + 4, count - 4);
  return made;
}

void close_fake(Fake* s) noexcept {
  if (s != nullptr) --open;
  delete s;
}

floatframe_status start_fake(Fake* s) noexcept {
  auto& state = s->state;
  if (state.inputs[1] == 666.0) return s->say(FLOATFRAME_NO_START, "no equilibrium was found");
  state.time = 0.0;
  state.x = (state.inputs[0] + state.inputs[1]) / state.parameters[0];
  state.v = 0.0;
  state.failed = 0;
  state.steps = 0;
  s->started = true;
  s->look();
  return FLOATFRAME_OK;
}

floatframe_status step_fake_by(Fake* s, double h) noexcept {
  auto& state = s->state;
  if (!s->started) return s->say(FLOATFRAME_WRONG_ORDER, "not started");
  if (state.failed != 0 || state.time + h > state.parameters[2]) {
    state.failed = 1;
    return s->say(FLOATFRAME_STEP_FAILED, "the step failed: 100 % of #1 is gone");
  }
  const auto begin = std::chrono::steady_clock::now();
  state.v += h / state.parameters[1] *
             (state.inputs[0] + state.inputs[1] - state.parameters[0] * state.x - 0.3 * state.v);
  state.x += h * state.v;
  state.time += h;
  s->look();
  ++steps;
  ++state.steps;
  while (std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count() <
         least_seconds) {
  }
  return FLOATFRAME_OK;
}

floatframe_status set_fake_input(Fake* s, std::int32_t k, double value) noexcept {
  if (k < 0 || k > 1 || !std::isfinite(value))
    return s->say(FLOATFRAME_INVALID, "found no number, expected one");
  if (k == 1 && std::fabs(value) > 1000.0)
    return s->say(FLOATFRAME_INVALID, "found too much, expected -1000 to 1000");
  s->state.inputs[unsigned(k)] = k == 0 ? std::clamp(value, -100.0, 100.0) : value;
  return s->state.inputs[unsigned(k)] == value ? FLOATFRAME_OK
                                               : s->say(FLOATFRAME_WARNING, "force: clamped");
}

floatframe_status set_fake_parameter(Fake* s, std::int32_t k, double value) noexcept {
  if (k < 0 || k > 2 || !(value > 0.0))
    return s->say(FLOATFRAME_INVALID, "a parameter of the double is above 0");
  s->state.parameters[unsigned(k)] = value;
  return FLOATFRAME_OK;
}

floatframe_status set_fake_parameters(Fake* s, const std::int32_t* k, const double* values,
                                      std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i)
    if (s->started && k[i] == 1 && values[i] == 7.0)
      return s->say(FLOATFRAME_INVALID, "this mass stays as it is");
  for (std::size_t i = 0; i < count; ++i)
    if (const auto status = set_fake_parameter(s, k[i], values[i])) return status;
  return FLOATFRAME_OK;
}

floatframe_status save_fake(Fake* s, std::size_t* count) noexcept {
  if (!s->started) return s->say(FLOATFRAME_WRONG_ORDER, "not started");
  s->saved.resize(sizeof s->state);
  std::memcpy(s->saved.data(), &s->state, sizeof s->state);
  *count = s->saved.size();
  return FLOATFRAME_OK;
}

floatframe_status restore_fake(Fake* s, const void* bytes, std::size_t count) noexcept {
  if (count != sizeof s->state) return s->say(FLOATFRAME_INVALID, "of another size");
  std::memcpy(&s->state, bytes, count);
  s->started = true;
  s->look();
  return FLOATFRAME_OK;
}

floatframe_functions fake_table() {
  floatframe_functions f{};
  f.open_memory = &open_fake;
  f.close = &close_fake;
  f.message = [](const Fake* s) noexcept { return s->message.c_str(); };
  f.fingerprint = [](const Fake* s) noexcept { return s->fingerprint.c_str(); };
  f.start = &start_fake;
  f.reset = [](Fake* s) noexcept {
    s->started = false;
    return FLOATFRAME_OK;
  };
  f.note_count = [](const Fake* s) noexcept { return s->started ? 1 : 0; };
  f.note = [](const Fake*, std::int32_t) noexcept { return "the mass is at rest"; };
  f.time = [](const Fake* s) noexcept { return s->state.time; };
  f.step_size = [](const Fake*) noexcept { return fake_step; };
  f.step = [](Fake* s) noexcept { return step_fake_by(s, fake_step); };
  f.step_by = &step_fake_by;
  f.input_count = [](const Fake*) noexcept { return 2; };
  f.input = [](const Fake* s, std::int32_t k) noexcept { return s->state.inputs[unsigned(k)]; };
  f.input_initial = [](const Fake*, std::int32_t k) noexcept { return k == 0 ? 1.0 : 0.0; };
  f.set_input = &set_fake_input;
  f.output_count = [](const Fake*) noexcept { return 3; };
  f.output = [](const Fake* s, std::int32_t k) noexcept {
    return s->started ? s->outputs[unsigned(k)] : std::nan("");
  };
  f.parameter_count = [](const Fake*) noexcept { return 3; };
  f.parameter = [](const Fake* s, std::int32_t k) noexcept {
    return s->state.parameters[unsigned(k)];
  };
  f.set_parameter = &set_fake_parameter;
  f.set_parameters = &set_fake_parameters;
  f.step_count = [](const Fake* s) noexcept { return s->state.steps; };
  f.substep_count = [](const Fake* s) noexcept { return 2 * s->state.steps; };
  f.iteration_count = [](const Fake* s) noexcept { return 3 * s->state.steps; };
  f.save = &save_fake;
  f.saved = [](const Fake* s) noexcept { return static_cast<const void*>(s->saved.data()); };
  f.restore = &restore_fake;
  return f;
}

}  // namespace

const std::filesystem::path& fake_resources() {
  struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("floatframe fmi " + std::to_string(getpid()));
    Folder() {
      std::filesystem::create_directories(path);
      std::ofstream(path / "model.ffm", std::ios::binary) << "fake0123abcd";
    }
    ~Folder() {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  return folder.path;
}

int open_fakes() { return open; }
long fake_steps() { return steps; }
void slow_down_fakes(double seconds) { least_seconds = seconds; }

}  // namespace floatframe::testing

namespace floatframe::fmi {

const floatframe_functions& functions() noexcept {
  static const floatframe_functions table = testing::fake_table();
  return table;
}

}  // namespace floatframe::fmi
