// The functions of floatframe.h, but for `floatframe_open`.
#include <cmath>
#include <limits>

#include "floatframe/c_interface/floatframe.h"
#include "floatframe/c_interface/guard.hpp"
#include "floatframe/c_interface/simulation_handle.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/version.hpp"

namespace floatframe {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

std::int32_t count_of(const NamedColumns& columns) noexcept { return columns.count(); }

const char* text_at(const NamedColumns& columns, std::int32_t index,
                    std::string NamedColumn::*text) noexcept {
  const NamedColumn* column = columns.at(index);
  return column == nullptr ? nullptr : (column->*text).c_str();
}

double number_at(const std::vector<double>& numbers, std::int32_t index) noexcept {
  return index >= 0 && index < std::ssize(numbers) ? numbers[index] : no_number;
}

}  // namespace
}  // namespace floatframe

int32_t floatframe_interface_version(void) noexcept { return FLOATFRAME_INTERFACE_VERSION; }
const char* floatframe_version(void) noexcept { return FLOATFRAME_VERSION; }

floatframe_simulation* floatframe_open_memory(const void* bytes, size_t count, char* message,
                                              size_t size) noexcept {
  return floatframe::open_guarded(message, size, [&] {
    if (bytes == nullptr)
      throw floatframe::InputError(floatframe::ErrorCode::missing,
                                   "found NULL, expected the bytes of a packed model");
    return floatframe::opened_bytes({static_cast<const std::byte*>(bytes), count});
  });
}

void floatframe_close(floatframe_simulation* s) noexcept { delete s; }

const char* floatframe_message(const floatframe_simulation* s) noexcept {
  return s == nullptr ? "" : s->message.c_str();
}
const char* floatframe_model_name(const floatframe_simulation* s) noexcept {
  return s == nullptr ? "" : s->name().c_str();
}
const char* floatframe_fingerprint(const floatframe_simulation* s) noexcept {
  return s == nullptr ? "" : s->fingerprint().c_str();
}

floatframe_status floatframe_set_option(floatframe_simulation* s, const char* key,
                                        const char* value) noexcept {
  return floatframe::guarded(s, [&](auto& handle) { return handle.set_option(key, value); });
}
floatframe_status floatframe_start(floatframe_simulation* s) noexcept {
  return floatframe::guarded(s, [](auto& handle) { return handle.start(); });
}
floatframe_status floatframe_reset(floatframe_simulation* s) noexcept {
  return floatframe::guarded(s, [](auto& handle) { return handle.reset(); });
}
int32_t floatframe_note_count(const floatframe_simulation* s) noexcept {
  return s == nullptr ? 0 : std::int32_t(s->notes().size());
}
const char* floatframe_note(const floatframe_simulation* s, int32_t index) noexcept {
  if (s == nullptr || index < 0 || index >= std::ssize(s->notes())) return nullptr;
  return s->notes()[index].c_str();
}

double floatframe_time(const floatframe_simulation* s) noexcept {
  return s == nullptr || s->started() == nullptr ? floatframe::no_number : s->started()->time();
}
double floatframe_step_size(const floatframe_simulation* s) noexcept {
  return s == nullptr ? floatframe::no_number : s->step_size();
}
floatframe_status floatframe_step(floatframe_simulation* s) noexcept {
  return floatframe::guarded(s, [](auto& handle) { return handle.step(); });
}
floatframe_status floatframe_step_by(floatframe_simulation* s, double size) noexcept {
  return floatframe::guarded(s, [=](auto& handle) { return handle.step_by(size); });
}
int64_t floatframe_step_count(const floatframe_simulation* s) noexcept {
  return s == nullptr || s->started() == nullptr ? 0 : s->started()->counters().steps;
}
int64_t floatframe_substep_count(const floatframe_simulation* s) noexcept {
  return s == nullptr || s->started() == nullptr ? 0 : s->started()->counters().substeps;
}
int64_t floatframe_iteration_count(const floatframe_simulation* s) noexcept {
  return s == nullptr || s->started() == nullptr ? 0 : s->started()->counters().iterations;
}

int32_t floatframe_input_count(const floatframe_simulation* s) noexcept {
  return s == nullptr ? 0 : floatframe::count_of(s->input_columns());
}
const char* floatframe_input_name(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr
             ? nullptr
             : floatframe::text_at(s->input_columns(), index, &floatframe::NamedColumn::name);
}
const char* floatframe_input_unit(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr
             ? nullptr
             : floatframe::text_at(s->input_columns(), index, &floatframe::NamedColumn::unit);
}
double floatframe_input_initial(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr ? floatframe::no_number : floatframe::number_at(s->initial_inputs(), index);
}
double floatframe_input_low(const floatframe_simulation* s, int32_t index) noexcept {
  if (s == nullptr || s->input_columns().at(index) == nullptr) return floatframe::no_number;
  return s->model().inputs[index].low;
}
double floatframe_input_high(const floatframe_simulation* s, int32_t index) noexcept {
  if (s == nullptr || s->input_columns().at(index) == nullptr) return floatframe::no_number;
  return s->model().inputs[index].high;
}
int32_t floatframe_find_input(const floatframe_simulation* s, const char* name) noexcept {
  return s == nullptr ? -1 : s->input_columns().find(name);
}
double floatframe_input(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr ? floatframe::no_number : floatframe::number_at(s->inputs(), index);
}
floatframe_status floatframe_set_input(floatframe_simulation* s, int32_t index,
                                       double value) noexcept {
  return floatframe::guarded(s, [=](auto& handle) { return handle.set_input(index, value); });
}

int32_t floatframe_output_count(const floatframe_simulation* s) noexcept {
  return s == nullptr ? 0 : floatframe::count_of(s->output_columns());
}
const char* floatframe_output_name(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr
             ? nullptr
             : floatframe::text_at(s->output_columns(), index, &floatframe::NamedColumn::name);
}
const char* floatframe_output_unit(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr
             ? nullptr
             : floatframe::text_at(s->output_columns(), index, &floatframe::NamedColumn::unit);
}
int32_t floatframe_find_output(const floatframe_simulation* s, const char* name) noexcept {
  return s == nullptr ? -1 : s->output_columns().find(name);
}
double floatframe_output(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr ? floatframe::no_number : floatframe::number_at(s->outputs(), index);
}
const double* floatframe_outputs(const floatframe_simulation* s) noexcept {
  return s == nullptr ? nullptr : s->outputs().data();
}

int32_t floatframe_parameter_count(const floatframe_simulation* s) noexcept {
  return s == nullptr ? 0 : floatframe::count_of(s->parameter_columns());
}
const char* floatframe_parameter_name(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr
             ? nullptr
             : floatframe::text_at(s->parameter_columns(), index, &floatframe::NamedColumn::name);
}
const char* floatframe_parameter_unit(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr
             ? nullptr
             : floatframe::text_at(s->parameter_columns(), index, &floatframe::NamedColumn::unit);
}
const char* floatframe_parameter_about(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr
             ? nullptr
             : floatframe::text_at(s->parameter_columns(), index, &floatframe::NamedColumn::about);
}
int32_t floatframe_find_parameter(const floatframe_simulation* s, const char* name) noexcept {
  return s == nullptr ? -1 : s->parameter_columns().find(name);
}
double floatframe_parameter(const floatframe_simulation* s, int32_t index) noexcept {
  return s == nullptr ? floatframe::no_number : floatframe::number_at(s->parameters(), index);
}
floatframe_status floatframe_set_parameter(floatframe_simulation* s, int32_t index,
                                           double value) noexcept {
  return floatframe::guarded(s, [&](auto& handle) {
    return handle.set_parameters({&index, 1}, {&value, 1});
  });
}
floatframe_status floatframe_set_parameters(floatframe_simulation* s, const int32_t* indices,
                                            const double* values, size_t count) noexcept {
  return floatframe::guarded(s, [&](auto& handle) {
    if (count > 0 && (indices == nullptr || values == nullptr))
      throw floatframe::InputError(floatframe::ErrorCode::missing,
                                   "found NULL, expected the indices and values of parameters");
    return handle.set_parameters({indices, count}, {values, count});
  });
}

floatframe_status floatframe_save(floatframe_simulation* s, size_t* count) noexcept {
  if (count != nullptr) *count = 0;
  return floatframe::guarded(s, [&](auto& handle) {
    const floatframe_status status = handle.save();
    if (count != nullptr) *count = handle.saved().size();
    return status;
  });
}
const void* floatframe_saved(const floatframe_simulation* s) noexcept {
  return s == nullptr || s->saved().empty() ? nullptr : s->saved().data();
}
floatframe_status floatframe_restore(floatframe_simulation* s, const void* bytes,
                                     size_t count) noexcept {
  return floatframe::guarded(s, [&](auto& handle) {
    if (bytes == nullptr)
      throw floatframe::InputError(floatframe::ErrorCode::missing,
                                   "found NULL, expected the bytes of a saved state");
    return handle.restore({static_cast<const std::byte*>(bytes), count});
  });
}
