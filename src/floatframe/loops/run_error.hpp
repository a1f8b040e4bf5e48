#pragma once
#include <exception>
#include <string>
#include <utility>

#include "floatframe/core/diagnostics.hpp"

namespace floatframe {

/// A run that cannot start or continue: no assembly, a singular mass matrix, a loop that cannot
/// close. Exit code 1.
class RunError : public std::exception {
 public:
  RunError(ErrorCode code, std::string message, std::exception_ptr cause = nullptr)
      : code_(code), message_(std::move(message)), cause_(std::move(cause)) {}
  ErrorCode code() const noexcept { return code_; }
  /// What a function of the program has thrown, if that is the reason; else null.
  const std::exception_ptr& cause() const noexcept { return cause_; }
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  ErrorCode code_;
  std::string message_;
  std::exception_ptr cause_;
};

}  // namespace floatframe
