#pragma once
// Result of `Simulation::save` and argument of `Simulation::restore`: everything that determines
// the next steps, so that a continued simulation makes the same steps, bit for bit, in the same
// program or in another process.
//
// As bytes: the magic word and the version, then the content, then a checksum of everything before
// it. Numbers are little-endian; doubles are stored bit by bit. The model itself is not included,
// only a fingerprint of the data that determine its motion.
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace floatframe {

class SimulationState {
 public:
  /// An empty state: `restore` rejects it.
  SimulationState() = default;

  bool empty() const noexcept { return data_ == nullptr; }
  /// [s]; 0 if it is empty.
  double time() const noexcept;

  /// Throws InputError if it is empty.
  std::vector<std::byte> to_bytes() const;
  /// Throws InputError for bytes that are damaged, incomplete or of another version.
  static SimulationState from_bytes(std::span<const std::byte> bytes);

 private:
  friend class Simulation;
  struct Data;
  explicit SimulationState(std::shared_ptr<const Data> data) : data_(std::move(data)) {}
  std::shared_ptr<const Data> data_;
};

}  // namespace floatframe
