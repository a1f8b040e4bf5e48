#pragma once
// The linear single-track model with the axle stiffnesses C_f, C_r [N/rad]:
//   m v (beta' + r) = C_f (delta - beta - a r/v) + C_r (-beta + b r/v)
//   I r' = a C_f (delta - beta - a r/v) - b C_r (-beta + b r/v)
// and the tables of tests/data/vehicle.
#include <Eigen/Dense>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

namespace floatframe::test {

struct SingleTrack {
  double m = 0, I = 0, a = 0, b = 0, Cf = 0, Cr = 0;

  /// Of (beta, r) with the input delta.
  Eigen::Matrix2d matrix(double v) const {
    const double first = (a * Cf - b * Cr), second = a * a * Cf + b * b * Cr;
    Eigen::Matrix2d A;
    A << -(Cf + Cr) / (m * v), -1.0 - first / (m * v * v), -first / I, -second / (I * v);
    return A;
  }
  Eigen::Vector2d input(double v) const { return {Cf / (m * v), a * Cf / I}; }
  Eigen::Vector2d steady(double v, double delta) const {
    return -matrix(v).inverse() * input(v) * delta;
  }
};

/// The exponential of a small matrix.
inline Eigen::MatrixXd exponential(const Eigen::MatrixXd& A) {
  Eigen::MatrixXd term = Eigen::MatrixXd::Identity(A.rows(), A.cols()), sum = term;
  for (int k = 1; k < 25; ++k) term = (term * A / k).eval(), sum += term;
  return sum;
}

/// A row by the names of its columns, as text.
using TableRow = std::map<std::string, std::string>;
inline std::vector<TableRow> vehicle_table(const std::string& name) {
  std::ifstream file(std::string(FLOATFRAME_TEST_DATA) + "/vehicle/" + name);
  std::vector<TableRow> rows;
  std::vector<std::string> header;
  for (std::string line; std::getline(file, line);) {
    if (line.ends_with('\r')) line.pop_back();
    std::vector<std::string> cells;
    std::stringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    cells.resize(std::max(cells.size(), header.size()));
    if (header.empty()) {
      header = cells;
      continue;
    }
    TableRow row;
    for (std::size_t k = 0; k < header.size(); ++k) row[header[k]] = cells[k];
    rows.push_back(row);
  }
  return rows;
}
inline double number(const TableRow& row, const std::string& column) {
  return std::stod(row.at(column));
}

inline SingleTrack single_track(const std::string& vehicle) {
  for (const TableRow& row : vehicle_table("singletrack_parameters.csv"))
    if (row.at("vehicle") == vehicle)
      return {number(row, "m_kg"), number(row, "Iz_kgm2"),       number(row, "a_m"),
              number(row, "b_m"),  number(row, "Cf_N_rad_axle"), number(row, "Cr_N_rad_axle")};
  return {};
}

}  // namespace floatframe::test
