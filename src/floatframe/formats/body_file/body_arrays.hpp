#pragma once
// Between the matrices of a reduced part and the arrays of a body file. Modal fields over points
// are arrays of three dimensions: point, component, mode.
#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// Degrees of freedom of an interface, as the header names them.
inline constexpr const char* interface_directions[6] = {"x", "y", "z", "rx", "ry", "rz"};

/// A matrix as an array of its rows.
NpyArray array_of(const MatX& matrix);
/// Rows of `matrix` in groups: rows/group x group x columns.
NpyArray grouped_array(const MatX& matrix, std::size_t group);
NpyArray list_of(const VecX& vector);
template <std::size_t N>
NpyArray array_of(const std::vector<std::array<int, N>>& rows) {
  std::vector<std::int32_t> values;
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return {{rows.size(), N}, std::move(values)};
}

/// Arrays of an archive by name. Every accessor adds an error that names the member if it is
/// missing or has another type or shape, or values that are not finite, and returns zeros of the
/// right shape (or nothing), so that all errors of a file are found at once.
class ArrayReader {
 public:
  ArrayReader(const std::vector<ZipMember>& members, std::string file, ErrorList& errors)
      : members_(members), file_(std::move(file)), errors_(errors) {}

  bool has(const std::string& name) const { return find(name) != nullptr; }
  double number(const std::string& name);
  VecX list(const std::string& name, Eigen::Index size);
  MatX matrix(const std::string& name, Eigen::Index rows, Eigen::Index columns);
  /// points x `group` x columns as a matrix with points * group rows.
  MatX grouped(const std::string& name, Eigen::Index points, Eigen::Index group,
               Eigen::Index columns);
  /// Integers from 0 to below `limit`; one dimension, or `columns` a row.
  std::vector<int> integers(const std::string& name, std::optional<std::size_t> columns,
                            std::int64_t limit);
  /// Size of the first dimension; 0 and an error if the member is missing or damaged.
  Eigen::Index length(const std::string& name);
  void error(ErrorCode code, const std::string& name, const std::string& sentence);
  template <class First, class... Rest>
  void error(ErrorCode code, const std::string& name, fmt::format_string<First, Rest...> text,
             First&& first, Rest&&... rest) {
    error(code, name, fmt::format(text, std::forward<First>(first), std::forward<Rest>(rest)...));
  }

 private:
  const ZipMember* find(const std::string& name) const;
  std::optional<NpyArray> load(const std::string& name);
  MatX zeros(Eigen::Index rows, Eigen::Index columns);
  /// Doubles of this shape, all finite.
  std::optional<std::vector<double>> doubles(const std::string& name,
                                             const std::vector<std::size_t>& shape);

  const std::vector<ZipMember>& members_;
  std::string file_;
  ErrorList& errors_;
};

}  // namespace floatframe
