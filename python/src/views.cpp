#include "views.hpp"

namespace floatframe::python {

View<double> points_view(const Mat3X& p, Owner owner) {
  return view(p.data(), {static_cast<std::size_t>(p.cols()), 3}, {3, 1}, std::move(owner));
}

View<double> shapes_view(const MatX& X, Owner owner) {
  return view(X.data(),
              {static_cast<std::size_t>(X.rows() / 3), 3, static_cast<std::size_t>(X.cols())},
              {3, 1, static_cast<std::int64_t>(X.rows())}, std::move(owner));
}

MatX matrix_of(const double* data, std::size_t rows, std::size_t columns) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  if (rows * columns == 0)
    return MatX::Zero(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
  return Eigen::Map<const Rows>(data, static_cast<Eigen::Index>(rows),
                                static_cast<Eigen::Index>(columns));
}

}  // namespace floatframe::python
