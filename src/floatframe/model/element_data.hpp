#pragma once
// What the kind of an element has computed from its keys, as the type that the kind knows.
#include "floatframe/model/model.hpp"

namespace floatframe {

template <class Data>
const Data& data_of(const Element& element) noexcept {
  return *static_cast<const Data*>(element.data.get());
}

}  // namespace floatframe
