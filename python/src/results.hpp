#pragma once
// Members of plain structs as attributes: matrices and vectors as arrays that look at the struct
// and keep it alive.
#include <nanobind/eigen/dense.h>

#include "bindings.hpp"

namespace floatframe::python {

/// An attribute: numbers, words, lists of them, other results.
template <class S, class T>
void value(nb::class_<S>& c, const char* name, T S::*member, const char* doc) {
  c.def_prop_ro(
      name, [member](const S& s) -> const T& { return s.*member; }, doc);
}

/// A list of numbers as an array.
template <class S>
void numbers(nb::class_<S>& c, const char* name, std::vector<double> S::*member, const char* doc) {
  c.def_prop_ro(
      name,
      [member](const nb::handle self) {
        const std::vector<double>& v = nb::cast<const S&>(self).*member;
        return nb::ndarray<nb::numpy, const double, nb::ndim<1>>(v.data(), {v.size()}, self);
      },
      nb::rv_policy::reference, doc);
}

/// A matrix or vector as an array.
template <class S, class T>
void array(nb::class_<S>& c, const char* name, T S::*member, const char* doc) {
  c.def_ro(name, member, doc);
}

}  // namespace floatframe::python
