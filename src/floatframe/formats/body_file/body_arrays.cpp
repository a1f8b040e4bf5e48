#include "floatframe/formats/body_file/body_arrays.hpp"

#include <cmath>

namespace floatframe {
namespace {

using RowMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

std::size_t size(Eigen::Index n) { return n; }

std::vector<double> rows_of(const MatX& matrix) {
  std::vector<double> values(size(matrix.size()));
  Eigen::Map<RowMatrix>(values.data(), matrix.rows(), matrix.cols()) = matrix;
  return values;
}

MatX or_zeros(const MatX& m, Eigen::Index rows, Eigen::Index columns) {
  return m.size() > 0 ? m : MatX(MatX::Zero(rows, columns));
}

}  // namespace

NpyArray array_of(const MatX& matrix) {
  return {{size(matrix.rows()), size(matrix.cols())}, rows_of(matrix)};
}

NpyArray list_of(const VecX& vector) {
  return {{size(vector.size())}, std::vector<double>(vector.data(), vector.data() + vector.size())};
}

void ArrayWriter::matrix(const std::string& name, const MatX& m, Eigen::Index rows,
                         Eigen::Index columns) {
  add(name, array_of(or_zeros(m, rows, columns)));
}

void ArrayWriter::grouped(const std::string& name, const MatX& m, Eigen::Index points,
                          Eigen::Index group, Eigen::Index columns) {
  add(name,
      {{size(points), size(group), size(columns)}, rows_of(or_zeros(m, points * group, columns))});
}

const ZipMember* ArrayReader::find(const std::string& name) const {
  for (const ZipMember& m : members_)
    if (m.name == name + ".npy") return &m;
  return nullptr;
}

std::optional<NpyArray> ArrayReader::load(const std::string& name) {
  const ZipMember* m = find(name);
  if (!m) {
    error(ErrorCode::missing, name, "is missing");
    return std::nullopt;
  }
  try {
    return read_npy(m->content);
  } catch (const InputError& damage) {
    error(damage.errors().front().code, name, "{}", damage.what());
    return std::nullopt;
  }
}

std::optional<std::vector<double>> ArrayReader::doubles(const std::string& name,
                                                        const std::vector<std::size_t>& shape) {
  auto array = load(name);
  if (!array) return std::nullopt;
  auto* values = std::get_if<std::vector<double>>(&array->values);
  if (array->shape != shape || !values) {
    error(ErrorCode::wrong_count, name, "found {}{}, expected {}", shape_text(array->shape),
          values ? "" : " of integers", shape_text(shape));
    return std::nullopt;
  }
  for (std::size_t k = 0; k < values->size(); ++k)
    if (!std::isfinite((*values)[k])) {
      error(ErrorCode::not_finite, name, "found {} as value {}, expected finite numbers",
            (*values)[k], k + 1);
      return std::nullopt;
    }
  return std::move(*values);
}

MatX ArrayReader::zeros(Eigen::Index rows, Eigen::Index columns) {
  // No memory for array sizes that a damaged file claims but does not contain.
  if (rows > 0 && columns > 1'000'000 / rows) errors_.throw_if_any();
  return MatX::Zero(rows, columns);
}

double ArrayReader::number(const std::string& name) {
  const auto values = doubles(name, {});
  return values ? values->front() : 0.0;
}

VecX ArrayReader::list(const std::string& name, Eigen::Index n) {
  const auto values = doubles(name, {size(n)});
  return values ? VecX(Eigen::Map<const VecX>(values->data(), n)) : VecX(zeros(n, 1));
}

MatX ArrayReader::matrix(const std::string& name, Eigen::Index rows, Eigen::Index columns) {
  const auto values = doubles(name, {size(rows), size(columns)});
  if (!values) return zeros(rows, columns);
  return Eigen::Map<const RowMatrix>(values->data(), rows, columns);
}

MatX ArrayReader::grouped(const std::string& name, Eigen::Index points, Eigen::Index group,
                          Eigen::Index columns) {
  const auto values = doubles(name, {size(points), size(group), size(columns)});
  if (!values) return zeros(points * group, columns);
  return Eigen::Map<const RowMatrix>(values->data(), points * group, columns);
}

std::vector<int> ArrayReader::integers(const std::string& name, std::optional<std::size_t> columns,
                                       std::int64_t limit) {
  const auto array = load(name);
  if (!array) return {};
  const bool right = array->shape.size() == (columns ? 2u : 1u) &&
                     (!columns || array->shape[1] == *columns) && array->values.index() > 0;
  if (!right) {
    error(ErrorCode::wrong_count, name, "found {}{}, expected {} integers",
          shape_text(array->shape), array->values.index() == 0 ? " of doubles" : "",
          columns ? fmt::format("rows of {}", *columns) : "a list of");
    return {};
  }
  std::vector<int> out;
  const auto take = [&](const auto& values) {
    for (const auto x : values) {
      if (x < 0 || x >= limit) {
        error(ErrorCode::out_of_range, name, "found {} as value {}, expected a number from 0 to {}",
              x, out.size() + 1, limit - 1);
        out.clear();
        return;
      }
      out.push_back(static_cast<int>(x));
    }
  };
  if (const auto* v = std::get_if<std::vector<std::int32_t>>(&array->values)) take(*v);
  if (const auto* v = std::get_if<std::vector<std::int64_t>>(&array->values)) take(*v);
  return out;
}

Eigen::Index ArrayReader::length(const std::string& name) {
  const auto array = load(name);
  if (!array) return 0;
  if (array->shape.empty()) {
    error(ErrorCode::wrong_count, name, "found {}, expected rows", shape_text(array->shape));
    return 0;
  }
  const std::size_t values = std::visit([](const auto& v) { return v.size(); }, array->values);
  return static_cast<Eigen::Index>(std::min(array->shape.front(), values));
}

}  // namespace floatframe
