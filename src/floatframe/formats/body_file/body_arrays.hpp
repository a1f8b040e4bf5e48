#pragma once
// Between the matrices of a reduced part and the arrays of a body file. Modal fields over points
// are arrays of three dimensions: point, component, mode.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/body_file/npy.hpp"
#include "floatframe/formats/body_file/zip_store.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

/// A matrix as an array of its rows.
NpyArray array_of(const MatX& matrix);
NpyArray list_of(const VecX& vector);

using NamedBytes = std::vector<std::pair<std::string, std::string>>;

/// The members of an archive. Lists of members that are both written and read make the same calls
/// of a writer and a reader, which take what is written or set what is read.
class ArrayWriter {
 public:
  explicit ArrayWriter(NamedBytes& out) : out_(out) {}

  void add(const std::string& name, const NpyArray& array) {
    out_.emplace_back(name, npy_bytes(array));
  }
  /// Is an optional member written?
  static bool wants(const std::string& /*name*/, bool there) { return there; }
  void number(const std::string& name, double x) { add(name, {{}, std::vector<double>{x}}); }
  void list(const std::string& name, const VecX& v) { add(name, list_of(v)); }
  /// Its rows; zeros if it is empty.
  void matrix(const std::string& name, const MatX& m, Eigen::Index rows, Eigen::Index columns);
  /// Columns of `points` as rows.
  void points(const std::string& name, const Mat3X& points, Eigen::Index count) {
    matrix(name, points.transpose(), count, 3);
  }
  /// Rows in groups: points x group x columns.
  void grouped(const std::string& name, const MatX& m, Eigen::Index points, Eigen::Index group,
               Eigen::Index columns);
  /// of(k): row k, a Vec3.
  template <class Of>
  void rows(const std::string& name, Eigen::Index count, Of of) {
    MatX all(count, 3);
    for (Eigen::Index k = 0; k < count; ++k) all.row(k) = of(k).transpose();
    matrix(name, all, count, 3);
  }
  /// of(k): a matrix of `group` rows; count x group x columns.
  template <class Of>
  void stack(const std::string& name, Eigen::Index count, Eigen::Index group, Eigen::Index columns,
             Of of) {
    MatX all(count * group, columns);
    for (Eigen::Index k = 0; k < count && columns > 0; ++k)
      all.middleRows(k * group, group) = of(k);
    grouped(name, all, count, group, columns);
  }
  template <std::size_t N>
  void integers(const std::string& name, const std::vector<std::array<int, N>>& rows) {
    std::vector<std::int32_t> values;
    for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
    add(name, {{rows.size(), N}, std::move(values)});
  }
  void integers(const std::string& name, const std::vector<int>& values) {
    add(name, {{values.size()}, std::vector<std::int32_t>(values.begin(), values.end())});
  }

 private:
  NamedBytes& out_;
};

/// Arrays of an archive by name. Every accessor adds an error with the name of the member if it is
/// missing or has another type or shape, or values that are not finite, and returns zeros of the
/// right shape (or an empty one), so that all errors of a file are found at once.
class ArrayReader {
 public:
  ArrayReader(const std::vector<ZipMember>& members, std::string file, ErrorList& errors)
      : members_(members), file_(std::move(file)), errors_(errors) {}

  bool has(const std::string& name) const { return find(name) != nullptr; }
  bool has_any(std::initializer_list<const char*> names) const {
    return std::any_of(names.begin(), names.end(), [this](const char* n) { return has(n); });
  }
  double number(const std::string& name);
  VecX list(const std::string& name, Eigen::Index size);
  MatX matrix(const std::string& name, Eigen::Index rows, Eigen::Index columns);
  /// points x `group` x columns as a matrix with points * group rows.
  MatX grouped(const std::string& name, Eigen::Index points, Eigen::Index group,
               Eigen::Index columns);
  /// Integers from 0 to below `limit`; one dimension, or `columns` per row.
  std::vector<int> integers(const std::string& name, std::optional<std::size_t> columns,
                            std::int64_t limit);
  /// N a row.
  template <std::size_t N>
  std::vector<std::array<int, N>> integers(const std::string& name, std::int64_t limit) {
    const std::vector<int> flat = integers(name, N, limit);
    std::vector<std::array<int, N>> out(flat.size() / N);
    for (std::size_t k = 0; k < flat.size(); ++k) out[k / N][k % N] = flat[k];
    return out;
  }

  // As in ArrayWriter.
  bool wants(const std::string& name, bool /*there*/) const { return has(name); }
  void number(const std::string& name, double& x) { x = number(name); }
  void list(const std::string& name, Vec3& v) { v = list(name, 3); }
  void list(const std::string& name, VecX& v) { v = list(name, length(name)); }
  template <class Matrix>
  void matrix(const std::string& name, Matrix& m, Eigen::Index rows, Eigen::Index columns) {
    m = matrix(name, rows, columns);
  }
  void points(const std::string& name, Mat3X& points, Eigen::Index count) {
    points = matrix(name, count, 3).transpose();
  }
  void grouped(const std::string& name, MatX& m, Eigen::Index points, Eigen::Index group,
               Eigen::Index columns) {
    m = grouped(name, points, group, columns);
  }
  template <class Of>
  void rows(const std::string& name, Eigen::Index count, Of of) {
    const MatX all = matrix(name, count, 3);
    for (Eigen::Index k = 0; k < count; ++k) of(k) = all.row(k).transpose();
  }
  template <class Of>
  void stack(const std::string& name, Eigen::Index count, Eigen::Index group, Eigen::Index columns,
             Of of) {
    const MatX all = grouped(name, count, group, columns);
    for (Eigen::Index k = 0; k < count; ++k) of(k) = all.middleRows(k * group, group);
  }

  /// Size of the first dimension; 0 and an error if the member is missing or damaged.
  Eigen::Index length(const std::string& name);
  template <class... Values>
  void error(ErrorCode code, const std::string& name, fmt::format_string<Values...> text,
             Values&&... values) {
    errors_.add(code, {file_, 0, 0},
                "member '" + name + ".npy': " + fmt::format(text, std::forward<Values>(values)...));
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
