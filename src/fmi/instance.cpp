#include "fmi/instance.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>

#include "fmi/resources.hpp"

namespace floatframe::fmi {
namespace {

/// A hash, whether written as {01234567-89ab-...} or as plain digits of either case.
std::string hex_digits(const char* text) {
  std::string digits;
  for (const char* c = text; *c != '\0'; ++c)
    if (std::isxdigit(static_cast<unsigned char>(*c)) != 0)
      digits += static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
  return digits;
}

bool is_blank(const char* text) {
  return text == nullptr || std::strspn(text, " \t\r\n") == std::strlen(text);
}

/// Opens the model; NULL: the log says why.
floatframe_simulation* open_model(const InstanceOptions& options, Log& log) {
  const floatframe_functions& f = functions();
  const auto refuse = [&log](const char* what, const char* found) {
    log.write(Status::error, Category::error, "%s%s", what, found);
    return nullptr;
  };
  if (is_blank(options.name)) return refuse("found no name of the instance, expected one", "");
  if (options.token == nullptr)
    return refuse("found no token, expected that of modelDescription.xml", "");
  if (options.resources == nullptr)
    return refuse("found no folder of resources, expected that of the unzipped FMU", "");
  const std::string path = model_path(options.resources);
  if (path.empty())
    return refuse("expected resources in a local folder (file:///...), found ", options.resources);
  std::vector<unsigned char> bytes;
  if (!read_file(path, bytes)) return refuse("cannot read the packed model ", path.c_str());
  char message[512] = "";
  floatframe_simulation* const simulation =
      f.open_memory(bytes.data(), bytes.size(), message, sizeof message);
  if (simulation == nullptr) {
    log.write(Status::error, Category::error, "%s: %s", path.c_str(), message);
    return nullptr;
  }
  const char* const fingerprint = f.fingerprint(simulation);
  if (hex_digits(options.token) != hex_digits(fingerprint)) {
    log.write(Status::error, Category::error,
              "found the token '%s', expected that of the model in resources, '%s'", options.token,
              fingerprint);
    f.close(simulation);
    return nullptr;
  }
  return simulation;
}

}  // namespace

Instance* Instance::make(const InstanceOptions& options, const std::uint32_t* variables,
                         std::size_t count) noexcept {
  try {
    // Why there is no instance is said whether the importer logs or not: it cannot be asked later.
    Log log(options.importer, options.name != nullptr ? options.name : "", true);
    floatframe_simulation* const simulation = open_model(options, log);
    if (simulation == nullptr) return nullptr;
    std::unique_ptr<Instance> made;
    try {
      made.reset(new Instance(options, simulation));
    } catch (...) {
      functions().close(simulation);
      throw;
    }
    if (count > 0 && variables == nullptr) {
      log.write(Status::error, Category::error, "found no variables of updates, expected %zu",
                count);
      return nullptr;
    }
    for (std::size_t k = 0; k < count; ++k) {
      const Kind kind = made->variable(variables[k]).kind;
      if (kind != Kind::none && kind != Kind::input) continue;
      log.write(Status::error, Category::error,
                "found value reference %u for intermediate updates, expected those of outputs",
                unsigned(variables[k]));
      return nullptr;
    }
    return made.release();
  } catch (...) {
    return nullptr;
  }
}

Instance::Instance(const InstanceOptions& options, floatframe_simulation* simulation)
    : simulation_(simulation),
      version_(options.version),
      log_(options.importer, options.name, options.logging),
      update_(options.update),
      environment_(options.importer.environment),
      early_return_(options.early_return) {
  for (std::int32_t k = 0; k < f_.input_count(simulation_); ++k)
    first_inputs_.push_back(f_.input_initial(simulation_, k));
  for (std::int32_t k = 0; k < f_.parameter_count(simulation_); ++k)
    first_parameters_.push_back(f_.parameter(simulation_, k));
  indices_.reserve(first_parameters_.size());
  numbers_.reserve(std::max(first_parameters_.size(), first_inputs_.size()));
}

Instance::~Instance() { f_.close(simulation_); }

Status Instance::begin(Call call, const char* function) noexcept {
  function_ = function;
  if (is_allowed(call, state_)) return Status::ok;
  if (call == Call::never) return fail("this FMU does not offer it");
  return fail("found the state '%s', in which this call is not allowed",
              state_names[unsigned(state_)]);
}

Status Instance::fail(const char* format, ...) noexcept {
  std::array<char, 900> text{};
  std::va_list values;
  va_start(values, format);
  std::vsnprintf(text.data(), text.size(), format, values);
  va_end(values);
  log_.write(Status::error, Category::error, "%s: %s", function_, text.data());
  state_ = after_error();
  return Status::error;
}

Status Instance::set_logging(bool on, std::size_t count, const char* const* categories) noexcept {
  return log_.choose(on, count, categories) ? Status::ok : Status::warning;
}

Status Instance::set_up(double start, bool has_stop, double stop) noexcept {
  if (!std::isfinite(start)) return fail("found the start time %g, expected a number", start);
  if (has_stop && !(stop >= start))
    return fail("found the stop time %g, expected one that is not before the start %g", stop,
                start);
  run_.start = start;
  run_.stop = has_stop ? stop : std::numeric_limits<double>::infinity();
  if (start == 0.0) return Status::ok;
  log_.write(Status::warning, Category::warning,
             "%s: found the start time %g s: the functions of time in this model begin at its own "
             "time 0 all the same",
             function_, start);
  return Status::warning;
}

Status Instance::enter_initialization() noexcept {
  state_ = State::initialization;
  return Status::ok;
}

Status Instance::exit_initialization() noexcept {
  const Status status = ensure_start();
  if (status != Status::error) state_ = State::stepping;
  return status;
}

Status Instance::ensure_start() noexcept {
  if (!run_.needs_start) return Status::ok;
  const floatframe_status found = f_.start(simulation_);
  if (found != FLOATFRAME_OK && found != FLOATFRAME_WARNING)
    return fail("%s", f_.message(simulation_));
  run_.needs_start = false;
  run_.shift = run_.start - f_.time(simulation_);
  for (std::int32_t k = 0; k < f_.note_count(simulation_); ++k)
    log_.write(Status::ok, Category::start, "%s", f_.note(simulation_, k));
  return worse(Status::ok, found);
}

void Instance::unstart() noexcept {
  f_.reset(simulation_);
  run_.needs_start = true;
}

Status Instance::terminate() noexcept {
  state_ = State::terminated;
  return Status::ok;
}

Status Instance::reset() noexcept {
  SavedState first;
  first.inputs = first_inputs_;
  first.parameters = first_parameters_;
  return apply(first);
}

}  // namespace floatframe::fmi
