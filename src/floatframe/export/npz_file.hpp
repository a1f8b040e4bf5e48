#pragma once
// Arrays of NumPy in one file (.npz), by name.
#include <string>
#include <utility>
#include <vector>

#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"

namespace floatframe {

class NpzFile {
 public:
  /// The number of values must match the shape.
  template <class Number>
  void add(const std::string& name, std::vector<std::size_t> shape, std::vector<Number> values) {
    members_.emplace_back(name + ".npy", npy_bytes({std::move(shape), std::move(values)}));
  }
  void add(const std::string& name, const std::vector<std::string>& texts) {
    members_.emplace_back(name + ".npy", npy_texts(texts));
  }
  std::size_t size() const noexcept { return members_.size(); }
  /// Throws InputError if it would be too large for the format.
  std::string bytes() const {
    std::vector<ZipMember> members;
    for (const auto& [name, content] : members_) members.push_back({name, content});
    return zip_archive(members);
  }

 private:
  std::vector<std::pair<std::string, std::string>> members_;
};

}  // namespace floatframe
