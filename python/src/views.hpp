#pragma once
// Numpy arrays that share memory of C++ and keep it alive. They are read-only: the data is shared
// and never changes.
#include "bindings.hpp"

namespace floatframe::python {

using Owner = std::shared_ptr<const void>;
using Sizes = std::vector<std::size_t>;
using Strides = std::vector<std::int64_t>;

template <class T>
using View = nb::ndarray<nb::numpy, const T>;
using Numbers3 = nb::typed<nb::tuple, View<double>, View<double>, View<double>>;

/// Strides are in numbers, not bytes.
template <class T>
View<T> view(const T* data, const Sizes& sizes, const Strides& strides, Owner owner) {
  static const T nothing{};
  nb::capsule keeper(new Owner(std::move(owner)),
                     [](void* p) noexcept { delete static_cast<Owner*>(p); });
  return View<T>(data ? data : &nothing, sizes.size(), sizes.data(), keeper, strides.data());
}

/// A matrix of columns: shape (rows, columns).
template <class Matrix>
View<double> matrix_view(const Matrix& a, Owner owner) {
  return view(a.data(), {static_cast<std::size_t>(a.rows()), static_cast<std::size_t>(a.cols())},
              {1, static_cast<std::int64_t>(a.rows())}, std::move(owner));
}

/// View of a vector or a matrix that has no other owner.
inline View<double> kept(VecX v) {
  const auto owner = std::make_shared<const VecX>(std::move(v));
  return view(owner->data(), {static_cast<std::size_t>(owner->size())}, {1}, owner);
}
inline View<double> kept(MatX a) {
  const auto owner = std::make_shared<const MatX>(std::move(a));
  return matrix_view(*owner, owner);
}

/// A property that is a view of the result of `getter`.
template <class Class, class Getter>
void def_view(Class& c, const char* name, Getter getter) {
  c.def_prop_ro(name, getter, nb::rv_policy::reference);
}

/// 3 x n as n points: shape (n, 3).
View<double> points_view(const Mat3X& p, Owner owner);
/// 3n x nm as vectors of points: shape (n, 3, nm).
View<double> shapes_view(const MatX& X, Owner owner);

using AnyNumbers = nb::ndarray<const double, nb::c_contig, nb::device::cpu>;
using Vector3 = nb::ndarray<const double, nb::shape<3>, nb::c_contig, nb::device::cpu>;
using Matrix3 = nb::ndarray<const double, nb::shape<3, 3>, nb::c_contig, nb::device::cpu>;
using Points = nb::ndarray<const double, nb::shape<-1, 3>, nb::c_contig, nb::device::cpu>;
using Indices = nb::ndarray<const std::int64_t, nb::ndim<1>, nb::c_contig, nb::device::cpu>;

/// AnyNumbers in the order of rows, as a matrix.
MatX matrix_of(const double* data, std::size_t rows, std::size_t columns);
inline Vec3 vec3_of(const Vector3& v) { return {v.data()[0], v.data()[1], v.data()[2]}; }
inline Mat3 mat3_of(const Matrix3& a) { return matrix_of(a.data(), 3, 3); }

}  // namespace floatframe::python
