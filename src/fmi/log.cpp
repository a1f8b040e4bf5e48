#include "fmi/log.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <utility>

namespace floatframe::fmi {
namespace {

/// FMI 2 takes a message for a format of printf in which #...# is a value reference.
void escape(const char* text, std::array<char, 2048>& to) noexcept {
  std::size_t n = 0;
  for (const char* c = text; *c != '\0' && n + 3 < to.size(); ++c) {
    if (*c == '%' || *c == '#') to[n++] = *c;
    to[n++] = *c;
  }
  to[n] = '\0';
}

}  // namespace

Log::Log(const Importer& importer, std::string instance, bool on)
    : importer_(importer), instance_(std::move(instance)) {
  choose(on, 0, nullptr);
}

bool Log::choose(bool on, std::size_t count, const char* const* categories) noexcept {
  const bool always = importer_.log_message == nullptr;
  wanted_ = {always || on, always || on, on, on};
  if (!on || count == 0) return true;
  if (categories == nullptr) {
    write(Status::warning, Category::warning, "found no categories, expected %zu", count);
    return false;
  }
  wanted_ = {};
  const char* unknown = nullptr;
  for (std::size_t k = 0; k < count; ++k) {
    const char* const name = categories[k] != nullptr ? categories[k] : "NULL";
    const auto found =
        std::find_if(category_names.begin(), category_names.end(),
                     [name](const char* known) { return std::strcmp(known, name) == 0; });
    if (found != category_names.end()) {
      wanted_[std::size_t(found - category_names.begin())] = true;
    } else if (std::strcmp(name, "logAll") == 0) {  // a name of FMI 2, section 2.2.4
      choose_all();
    } else {
      unknown = name;
    }
  }
  if (unknown == nullptr) return true;
  write(
      Status::warning, Category::warning,
      "found the category '%s', expected logStatusError, logStatusWarning, logStart or logOverrun",
      unknown);
  return false;
}

void Log::write(Status status, Category category, const char* format, ...) noexcept {
  std::va_list values;
  va_start(values, format);
  write(status, category, format, values);
  va_end(values);
}

void Log::write(Status status, Category category, const char* format,
                std::va_list values) noexcept {
  if (!wants(category)) return;
  std::vsnprintf(text_.data(), text_.size(), format, values);
  const char* const name = category_names[unsigned(category)];
  if (importer_.log_message != nullptr) {
    importer_.log_message(importer_.environment, fmi3Status(status), name, text_.data());
  } else if (importer_.logger != nullptr) {
    escape(text_.data(), escaped_);
    importer_.logger(importer_.environment, instance_.c_str(), fmi2Status(status), name,
                     escaped_.data());
  }
}

}  // namespace floatframe::fmi
