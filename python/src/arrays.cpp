// Arrays for numpy.
#include <complex>

#include "bindings.hpp"

namespace floatframe::python {
namespace {

/// `count` numbers copied into memory that the array owns; `shape` in the order of rows.
template <class T>
nb::object owned(const T* data, std::size_t count, std::vector<std::size_t> shape,
                 std::vector<std::int64_t> strides) {
  auto kept = std::make_unique<T[]>(count);
  std::copy(data, data + count, kept.get());
  T* numbers = kept.get();
  nb::capsule owner(numbers, [](void* p) noexcept { delete[] static_cast<T*>(p); });
  kept.release();
  return nb::cast(
      nb::ndarray<nb::numpy, T>(numbers, shape.size(), shape.data(), owner, strides.data()));
}

template <class Matrix>
nb::object matrix(const Matrix& a) {
  const auto rows = static_cast<std::size_t>(a.rows()),
             columns = static_cast<std::size_t>(a.cols());
  return owned(a.data(), rows * columns, {rows, columns}, {1, static_cast<std::int64_t>(rows)});
}

template <class Vector>
nb::object vector(const Vector& v) {
  const auto size = static_cast<std::size_t>(v.size());
  return owned(v.data(), size, {size}, {1});
}

}  // namespace

RealArray array_of(const VecX& v) { return nb::borrow<RealArray>(vector(v)); }
RealArray array_of(const MatX& a) { return nb::borrow<RealArray>(matrix(a)); }
RealArray array_of(const std::vector<double>& v) { return nb::borrow<RealArray>(vector(v)); }
ComplexArray array_of(const Eigen::VectorXcd& v) { return nb::borrow<ComplexArray>(vector(v)); }
ComplexArray array_of(const Eigen::MatrixXcd& a) { return nb::borrow<ComplexArray>(matrix(a)); }

}  // namespace floatframe::python
