#pragma once
#include <exception>
#include <string>
#include <utility>

namespace floatframe {

/// A run that cannot start or go on: cannot be assembled, singular mass matrix, loop that cannot
/// close. Exit code 1.
class RunError : public std::exception {
 public:
  explicit RunError(std::string message) : message_(std::move(message)) {}
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

}  // namespace floatframe
