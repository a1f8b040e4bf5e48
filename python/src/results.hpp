#pragma once
// Members of plain structs as attributes: matrices and vectors as arrays that share the memory of
// the struct and keep it alive.
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

/// Numbers of a result as a read-only numpy array that keeps it alive.
template <class T>
auto view_of(const T& a, const nb::handle owner) {
  using Scalar = typename T::Scalar;
  static const Scalar nothing{};
  const auto rows = static_cast<std::size_t>(a.rows());
  const Scalar* data = a.size() > 0 ? a.data() : &nothing;
  if constexpr (T::ColsAtCompileTime == 1)
    return nb::ndarray<nb::numpy, const Scalar, nb::ndim<1>>(data, {rows}, owner);
  else
    return nb::ndarray<nb::numpy, const Scalar, nb::ndim<2>>(
        data, {rows, static_cast<std::size_t>(a.cols())}, owner,
        {1, static_cast<std::int64_t>(a.rows())});
}

/// A matrix or vector as an array.
template <class S, class T>
void array(nb::class_<S>& c, const char* name, T S::*member, const char* doc) {
  c.def_prop_ro(
      name,
      [member](const nb::handle self) { return view_of(nb::cast<const S&>(self).*member, self); },
      nb::rv_policy::reference, doc);
}

}  // namespace floatframe::python
