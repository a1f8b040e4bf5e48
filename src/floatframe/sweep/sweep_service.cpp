#include "floatframe/sweep/sweep_service.hpp"

#include <charconv>
#include <utility>

#include "floatframe/core/atomic_file.hpp"
#include "floatframe/core/enum_index.hpp"
#include "floatframe/run/run.hpp"

namespace floatframe {
namespace {

// A list of texts: "<length>:<bytes>" for each, so that they may contain any bytes.
void put(std::string& out, const std::string& field) {
  out += std::to_string(field.size());
  out += ':';
  out += field;
}
void put(std::string& out, std::size_t number) { put(out, std::to_string(number)); }

class Fields {
 public:
  explicit Fields(const std::string& text) : rest_(text) {}
  bool whole() const noexcept { return whole_ && rest_.empty(); }
  std::string text() {
    std::size_t size = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), size);
    const std::size_t colon = end - rest_.data();
    if (error != std::errc() || colon >= rest_.size() || rest_[colon] != ':' ||
        size > rest_.size() - colon - 1) {
      whole_ = false;
      rest_ = {};
      return "";
    }
    std::string field(rest_.substr(colon + 1, size));
    rest_.remove_prefix(colon + 1 + size);
    return field;
  }
  std::size_t number() {
    const std::string field = text();
    std::size_t value = 0;
    const char* const last = field.data() + field.size();
    const auto [end, error] = std::from_chars(field.data(), last, value);
    whole_ = whole_ && error == std::errc() && end == last;
    return whole_ ? value : 0;
  }
  /// Number of groups of texts that follow; each takes at least two bytes.
  std::size_t count() {
    const std::size_t n = number();
    whole_ = whole_ && n <= rest_.size();
    return whole_ ? n : 0;
  }

 private:
  std::string_view rest_;
  bool whole_ = true;
};

}  // namespace

std::string encode(const ServiceRequest& request) {
  std::string text;
  put(text, index_of(request.what));
  put(text, request.run);
  return text;
}

std::string encode(const ServiceAnswer& answer) {
  std::string text;
  put(text, index_of(answer.kind));
  put(text, answer.text);
  put(text, answer.errors.size());
  for (const ErrorEntry& error : answer.errors) {
    put(text, error.mark.file);
    put(text, error.mark.line);
    put(text, error.mark.column);
    put(text, index_of(error.code));
    put(text, error.message);
    put(text, error.path);
    put(text, error.count);
  }
  put(text, answer.files.size());
  for (const auto& [file, hash] : answer.files) {
    put(text, file);
    put(text, hash);
  }
  return text;
}

bool decode(const std::string& text, ServiceAnswer& answer) {
  Fields fields(text);
  answer = {};
  const std::size_t kind = fields.number();
  if (kind > index_of(ServiceAnswer::Kind::error)) return false;
  answer.kind = static_cast<ServiceAnswer::Kind>(kind);
  answer.text = fields.text();
  for (std::size_t n = fields.count(); n > 0; --n) {
    ErrorEntry error;
    error.mark.file = fields.text();
    error.mark.line = static_cast<int>(fields.number());
    error.mark.column = static_cast<int>(fields.number());
    const std::size_t code = fields.number();
    if (code > index_of(ErrorCode::worker_lost)) return false;
    error.code = static_cast<ErrorCode>(code);
    error.message = fields.text();
    error.path = fields.text();
    error.count = fields.number();
    answer.errors.push_back(std::move(error));
  }
  for (std::size_t n = fields.count(); n > 0; --n) {
    std::string file = fields.text();
    answer.files[std::move(file)] = fields.text();
  }
  return fields.whole();
}

std::string SweepService::answer(const ServiceRequest& request, WorkerState& state) {
  using What = ServiceRequest::What;
  if (!runner_) runner_ = std::make_unique<SweepRunner>(options_, cancel_);
  switch (request.what) {
    case What::open:
      break;
    case What::check:
      runner_->check(request.run);
      break;
    case What::build:
      runner_->model(request.run, runner_->prepare(request.run));
      break;
    case What::files:
      return runner_->files_of_first_run();
    case What::run:
      return runner_->line(request.run, state.progress);
  }
  return "";
}

std::string SweepService::serve(const std::string& request, WorkerState& state) {
  Fields fields(request);
  ServiceRequest decoded;
  decoded.what = static_cast<ServiceRequest::What>(fields.number());
  decoded.run = fields.number();
  ServiceAnswer out;
  try {
    out.text = answer(decoded, state);
  } catch (const RunCancelled&) {
    out.kind = ServiceAnswer::Kind::cancelled;
  } catch (const InputError& error) {
    out.kind = ServiceAnswer::Kind::errors;
    out.errors = error.errors();
  } catch (const OutputError& error) {
    out.kind = ServiceAnswer::Kind::error;
    out.text = error.what();
  } catch (const RunError& error) {
    out.kind = ServiceAnswer::Kind::error;
    out.text = error.what();
  }
  if (runner_ && runner_->files().size() > sent_files_.size()) {
    for (const auto& [file, hash] : runner_->files())
      if (sent_files_.emplace(file, hash).second) out.files.emplace(file, hash);
  }
  return encode(out);
}

}  // namespace floatframe
