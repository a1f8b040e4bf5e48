#pragma once
// Messages to the importer of an FMU: one sentence each, in one of four categories, which
// modelDescription.xml names. Texts are made in place: a message costs no memory.
#include <array>
#include <cstdarg>
#include <cstddef>
#include <string>

#include "fmi/fmi2_standard.h"
#include "fmi/fmi3_standard.h"

namespace floatframe::fmi {

/// With the numbers of fmi2Status and fmi3Status.
enum class Status { ok, warning, discard, error };

enum class Category { error, warning, start, overrun };
inline constexpr std::array<const char*, 4> category_names{"logStatusError", "logStatusWarning",
                                                           "logStart", "logOverrun"};

/// The callback of the importer, of one of the standards; none: nothing is said.
struct Importer {
  fmi2CallbackLogger logger = nullptr;
  fmi3LogMessageCallback log_message = nullptr;
  void* environment = nullptr;
};

class Log {
 public:
  /// Before a choice of categories: `on` chooses all. Else FMI 2 still hears of errors and
  /// warnings, since its logging "on" is that of debugging; FMI 3 hears nothing.
  Log(const Importer& importer, std::string instance, bool on);

  /// fmi2SetDebugLogging: no categories are all. False: one is unknown, which `write` has said.
  bool choose(bool on, std::size_t count, const char* const* categories) noexcept;
  bool wants(Category category) const noexcept { return wanted_[unsigned(category)]; }
  void choose_all() noexcept { wanted_.fill(true); }

#if defined(__GNUC__) && !defined(_WIN32)  // there it stands for the formats of msvcrt
  __attribute__((format(printf, 4, 5)))
#endif
  void
  write(Status status, Category category, const char* format, ...) noexcept;
  void write(Status status, Category category, const char* format, std::va_list values) noexcept;

 private:
  Importer importer_;
  std::string instance_;
  std::array<bool, 4> wanted_{};
  std::array<char, 1024> text_{};
  std::array<char, 2 * 1024> escaped_{};
};

}  // namespace floatframe::fmi
