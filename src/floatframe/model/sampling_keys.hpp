#pragma once
// The keys of kinds that are sampled, or may be (sampling.hpp).
#include <algorithm>
#include <array>

#include "floatframe/model/element_kind.hpp"
#include "floatframe/model/sampling.hpp"

namespace floatframe {

/// Keys of the struct S of a kind.
template <class S>
constexpr std::array<ElementKey, 3> sampling_keys(bool required = false) {
  return {{{.name = "period",
            .kind = KeyKind::number,
            .about = required ? "between two samples"
                              : "between two samples; without it it acts "
                                "continuously",
            .required = required,
            .rule = positive_number("s"),
            .fallback = no_number,
            .member = member<S, &Sampling::period>},
           {.name = "offset",
            .kind = KeyKind::number,
            .about = "time of the first sample",
            .rule = non_negative_number("s"),
            .fallback = no_number,
            .member = member<S, &Sampling::offset>},
           {.name = "delay",
            .kind = KeyKind::number,
            .about = "from a sample to when its value acts",
            .rule = non_negative_number("s"),
            .fallback = no_number,
            .member = member<S, &Sampling::delay>}}};
}
template <class S, std::size_t n>
constexpr std::array<ElementKey, n + 3> with_sampling(const ElementKey (&keys)[n]) {
  std::array<ElementKey, n + 3> out{};
  std::copy(keys, keys + n, out.begin());
  std::ranges::copy(sampling_keys<S>(), out.begin() + n);
  return out;
}
void validate_sampling(const ElementCheck& check);

}  // namespace floatframe
