#pragma once
// The numbers of a description among its bytes.
#include <bit>
#include <cstring>

#include "floatframe/packed/description_bytes.hpp"

namespace floatframe {

inline double number_at(const DescriptionBytes& d, std::size_t place) {
  std::uint64_t bits = 0;
  for (int k = 0; k < 8; ++k)
    bits |= std::to_integer<std::uint64_t>(d.bytes[d.doubles[place] + k]) << (8 * k);
  return std::bit_cast<double>(bits);
}

}  // namespace floatframe
