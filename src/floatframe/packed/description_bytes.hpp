#pragma once
// A description as bytes, for packed models: every number bit by bit, every
// text, also where the user wrote it (Origin). Little-endian, without gaps. What comes first are
// the numbers of a model file; reduced flexible bodies stand last, equal ones once.
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "floatframe/description/description.hpp"

namespace floatframe {

struct DescriptionBytes {
  std::vector<std::byte> bytes;
  std::vector<std::uint32_t> doubles;  ///< where each double begins, ascending
  /// Where flexible bodies begin. Descriptions that differ only in how these were described or
  /// reduced are equal before.
  std::uint32_t bodies = 0;
};

/// Laws that a program gives as a function have no bytes: InputError. Frames of bars are written,
/// so that two of them can be compared, but not read.
DescriptionBytes description_bytes(const ModelDescription& description);
/// To be compared only: without the texts of formulas, with the same doubles in the same order.
DescriptionBytes bytes_without_formula_texts(const ModelDescription& description);

/// Takes no more memory than a multiple of the bytes. What `build_model` takes for granted - sizes
/// of matrices, numbers of nodes, words by number, depth of formulas - has been checked. InputError
/// of code `damaged`.
ModelDescription description_of(std::span<const std::byte> bytes);

/// Differs where the order of the bytes does: a hash of the version and of the names of all keys of
/// all elements.
std::uint64_t description_layout();

}  // namespace floatframe
