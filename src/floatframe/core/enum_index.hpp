#pragma once
// Enumerators as indices of tables in enumerator order.
#include <cstddef>
#include <type_traits>

namespace floatframe {

template <class E>
requires std::is_enum_v<E>
constexpr std::size_t index_of(E e) noexcept { return static_cast<std::size_t>(e); }

}  // namespace floatframe
