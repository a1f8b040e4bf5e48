#pragma once
#include <exception>
#include <string>
#include <utility>

namespace floatframe {

/// A file or folder that cannot be written; one sentence with the system's reason.
class OutputError : public std::exception {
 public:
  explicit OutputError(std::string message) : message_(std::move(message)) {}
  const char* what() const noexcept override { return message_.c_str(); }

 private:
  std::string message_;
};

}  // namespace floatframe
