// Torsion and shear of sections of plates: 9-node elements on a grid through all edges of the
// plates, finer towards the edges, where the stress changes within a wall's thickness.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "floatframe/fe/plate_section.hpp"
#include "floatframe/math/sparse_factors.hpp"

namespace floatframe {
namespace {

constexpr double thinnest = 1e-4;   ///< wall, of the size of the section
constexpr double same_edge = 1e-5;  ///< closer edges are merged

/// Edges of all plates along one axis, without duplicates within `same_edge`.
std::vector<double> plate_edges(std::span<const SectionPlate> plates, bool along_y) {
  std::vector<double> all;
  for (const SectionPlate& p : plates) {
    const double middle = along_y ? p.y : p.z, half = 0.5 * (along_y ? p.height : p.width);
    all.push_back(middle - half);
    all.push_back(middle + half);
  }
  std::sort(all.begin(), all.end());
  const double same = same_edge * (all.back() - all.front());
  std::vector<double> edges;
  for (const double x : all)
    if (edges.empty() || x - edges.back() > same) edges.push_back(x);
  return edges;
}

/// Ends of elements: from both edges of an interval at 1, 2, 4, ... times `first`.
std::vector<double> graded_ends(const std::vector<double>& edges, double first) {
  std::vector<double> ends;
  for (std::size_t k = 0; k + 1 < edges.size(); ++k) {
    const double a = edges[k], b = edges[k + 1], half = 0.5 * (b - a);
    std::vector<double> steps{0.0};
    for (double d = first; d < 0.99 * half; d *= 2.0) steps.push_back(d);
    for (const double d : steps) ends.push_back(a + d);
    ends.push_back(a + half);
    for (std::size_t i = steps.size(); i-- > 1;) ends.push_back(b - steps[i]);
  }
  ends.push_back(edges.back());
  return ends;
}

double shortest_step(const std::vector<double>& edges) {
  double least = edges.back() - edges.front();
  for (std::size_t k = 0; k + 1 < edges.size(); ++k)
    least = std::min(least, edges[k + 1] - edges[k]);
  return least;
}

using Mat9 = Eigen::Matrix<double, 9, 9>;

/// Products of the three shapes over a line of length h: of shapes, of slopes, of a slope (row) and
/// a shape.
struct LineProducts {
  explicit LineProducts(double h) {
    shapes << 4, 2, -1, 2, 16, 2, -1, 2, 4;
    slopes << 7, -8, 1, -8, 16, -8, 1, -8, 7;
    mixed << -3, -4, 1, 4, 0, -4, -1, 4, 3;
    shapes *= h / 30.0;
    slopes /= 3.0 * h;
    mixed /= 6.0;
  }
  Mat3 shapes, slopes, mixed;
};

/// Nodes of an element are y by y, z fastest.
Mat9 product(const Mat3& along_y, const Mat3& along_z) {
  Mat9 m;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) m.block<3, 3>(3 * i, 3 * j) = along_y(i, j) * along_z;
  return m;
}

class SectionGrid {
 public:
  SectionGrid(std::span<const SectionPlate> plates, std::vector<double> y, std::vector<double> z)
      : y_(std::move(y)), z_(std::move(z)), numbers_(rows() * (2 * z_.size() - 1), -1) {
    for (std::size_t i = 0; i + 1 < y_.size(); ++i)
      for (std::size_t j = 0; j + 1 < z_.size(); ++j) {
        const double cy = 0.5 * (y_[i] + y_[i + 1]), cz = 0.5 * (z_[j] + z_[j + 1]);
        const bool inside = std::any_of(plates.begin(), plates.end(), [&](const SectionPlate& p) {
          return std::abs(cy - p.y) < 0.5 * p.height && std::abs(cz - p.z) < 0.5 * p.width;
        });
        if (inside) cells_.push_back({i, j});
      }
    for (const auto& [i, j] : cells_)
      for (int k = 0; k < 9; ++k) {
        int& n = numbers_[place(i, j, k)];
        if (n < 0) n = nodes_++;
      }
  }

  SectionFlow solve(const PlateSums& s) const {
    const double twice = s.Iy * s.Iz - s.Iyz * s.Iyz;
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(cells_.size() * 81);
    MatX loads = MatX::Zero(nodes_, 3);  // of warping, of unit shear forces along y and z
    for (const auto& [i, j] : cells_) {
      const LineProducts ly(y_[i + 1] - y_[i]), lz(z_[j + 1] - z_[j]);
      const Mat9 K = product(ly.slopes, lz.shapes) + product(ly.shapes, lz.slopes);
      Eigen::Matrix<double, 9, 1> y, z;
      for (int k = 0; k < 9; ++k) {
        y(k) = y_[i] + 0.5 * (k / 3) * (y_[i + 1] - y_[i]) - s.y;
        z(k) = z_[j] + 0.5 * (k % 3) * (z_[j + 1] - z_[j]) - s.z;
      }
      Eigen::Matrix<double, 9, 3> load;
      load.col(0) = product(ly.mixed, lz.shapes) * z - product(ly.shapes, lz.mixed) * y;
      const Mat9 M = product(ly.shapes, lz.shapes);
      load.col(1) = M * (s.Iy * y - s.Iyz * z) / twice;
      load.col(2) = M * (s.Iz * z - s.Iyz * y) / twice;
      for (int a = 0; a < 9; ++a) {
        const int row = numbers_[place(i, j, a)];
        loads.row(row) += load.row(a);
        for (int b = 0; b < 9; ++b) {
          const int column = numbers_[place(i, j, b)];
          // Node 0 is held: w and f are determined up to a constant.
          if (row > 0 && column > 0) entries.emplace_back(row - 1, column - 1, K(a, b));
        }
      }
    }
    SectionFlow flow;
    Eigen::SparseMatrix<double> K(nodes_ - 1, nodes_ - 1);
    K.setFromTriplets(entries.begin(), entries.end());
    const SparseFactors factors(K);
    if (factors.singular() >= 0) return flow;
    const MatX b = loads.bottomRows(nodes_ - 1), x = factors.solve(b);
    const Eigen::Matrix3d products = x.transpose() * b;
    flow.J = torsion(x.col(0), s);
    flow.shear_flexibility = products.bottomRightCorner<2, 2>();
    // The torque of tau about the centroid, of unit forces.
    flow.center_y = s.y - products(2, 0);
    flow.center_z = s.z + products(1, 0);
    flow.found =
        products.allFinite() && flow.J > 0.0 && products(1, 1) > 0.0 && products(2, 2) > 0.0;
    return flow;
  }

 private:
  /// int (w,y - z)^2 + (w,z + y)^2: for thin walls Iy + Iz - int |grad w|^2 would be only
  /// rounding.
  double torsion(const VecX& warping, const PlateSums& s) const {
    constexpr double gauss = 0.7745966692414834;  // sqrt(3/5)
    constexpr std::array<double, 3> points{-gauss, 0.0, gauss}, weights{5.0 / 9, 8.0 / 9, 5.0 / 9};
    double J = 0.0;
    for (const auto& [i, j] : cells_) {
      const double hy = y_[i + 1] - y_[i], hz = z_[j + 1] - z_[j];
      Mat3 w;
      for (int k = 0; k < 9; ++k) {
        const int n = numbers_[place(i, j, k)];
        w(k / 3, k % 3) = n == 0 ? 0.0 : warping(n - 1);
      }
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b) {
          const double y = y_[i] + 0.5 * (1.0 + points[a]) * hy - s.y,
                       z = z_[j] + 0.5 * (1.0 + points[b]) * hz - s.z,
                       xy = 2.0 / hy * slopes(points[a]).dot(w * shapes(points[b])) - z,
                       xz = 2.0 / hz * shapes(points[a]).dot(w * slopes(points[b])) + y;
          J += 0.25 * hy * hz * weights[a] * weights[b] * (xy * xy + xz * xz);
        }
    }
    return J;
  }
  static Vec3 shapes(double x) { return {0.5 * x * (x - 1.0), 1.0 - x * x, 0.5 * x * (x + 1.0)}; }
  static Vec3 slopes(double x) { return {x - 0.5, -2.0 * x, x + 0.5}; }

  struct Cell {
    std::size_t y, z;
  };
  std::size_t rows() const { return 2 * y_.size() - 1; }
  std::size_t place(std::size_t i, std::size_t j, int k) const {
    return (2 * i + k / 3) * (2 * z_.size() - 1) + 2 * j + k % 3;
  }

  std::vector<double> y_, z_;
  std::vector<int> numbers_;  ///< of the nodes of the grid; -1: none
  std::vector<Cell> cells_;
  int nodes_ = 0;
};

}  // namespace

SectionFlow section_flow(std::span<const SectionPlate> plates) {
  const std::vector<double> y = plate_edges(plates, true), z = plate_edges(plates, false);
  const double size = std::max(y.back() - y.front(), z.back() - z.front()),
               least = std::min(shortest_step(y), shortest_step(z));
  for (const SectionPlate& p : plates)
    if (!(std::min(p.height, p.width) >= thinnest * size)) return {};
  const double first = 0.125 * std::max(least, 0.01 * size);
  return SectionGrid(plates, graded_ends(y, first), graded_ends(z, first))
      .solve(plate_sums(plates));
}

}  // namespace floatframe
