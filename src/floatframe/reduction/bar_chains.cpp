#include "floatframe/reduction/bar_chains.hpp"

#include <algorithm>
#include <cmath>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/fe/element_kernel.hpp"
#include "floatframe/math/frequency.hpp"

namespace floatframe {
namespace {

/// Up to here direct factors give seven accurate digits; the sixth is lost near 350.
constexpr std::size_t few_elements = 100;

/// Elements in a row, from node to node.
struct Chain {
  std::vector<int> nodes;
  int first_element = 0;
};

bool continues(const FeModel& model, const FeElement& a, const FeElement& b) {
  const ElementInput x = gather(model, a), y = gather(model, b);
  const Vec3 dx = x.p[1] - x.p[0], dy = y.p[1] - y.p[0];
  const BeamSection &s = x.section, &t = y.section;
  return a.nodes[1] == b.nodes[0] && a.material == b.material && a.reference == b.reference &&
         s.A == t.A && s.Iy == t.Iy && s.Iz == t.Iz && s.J == t.J && s.shear_y == t.shear_y &&
         s.shear_z == t.shear_z && s.slenderness == t.slenderness &&
         (dx - dy).norm() <= 1e-6 * dx.norm();
}

/// Rows of equal elements in a line; a node of the `special` ones ends a row.
std::vector<Chain> chains_of(const FeModel& model, std::vector<char> special) {
  std::vector<int> uses(model.positions.size(), 0);
  for (const FeElement& e : model.elements)
    for (int a = 0; a < 2; ++a) ++uses[e.nodes[a]];
  for (std::size_t k = 0; k < uses.size(); ++k)
    if (uses[k] != 2) special[k] = 1;
  std::vector<Chain> chains;
  for (std::size_t e = 0; e < model.elements.size(); ++e) {
    const FeElement& element = model.elements[e];
    const bool on =
        e > 0 && special[element.nodes[0]] == 0 && continues(model, model.elements[e - 1], element);
    if (!on) chains.push_back({{element.nodes[0]}, static_cast<int>(e)});
    chains.back().nodes.push_back(element.nodes[1]);
  }
  return chains;
}

/// Ends of the long beams, as places in the chain.
std::vector<std::size_t> cuts(const Chain& chain, std::size_t elements) {
  const std::size_t n = chain.nodes.size() - 1;
  const double length = std::sqrt(static_cast<double>(elements));
  const std::size_t beams = std::max(1.0, std::round(static_cast<double>(n) / length));
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i <= beams; ++i) places.push_back(i * n / beams);
  return places;
}

/// Displacements and rotations at s of a beam from those of its ends, local axes.
Eigen::Matrix<double, 6, 12> interpolation(double s, double L) {
  const double s2 = s * s, s3 = s2 * s;
  const double h[4] = {1 - 3 * s2 + 2 * s3, L * (s - 2 * s2 + s3), 3 * s2 - 2 * s3, L * (s3 - s2)};
  const double d[4] = {(-6 * s + 6 * s2) / L, 1 - 4 * s + 3 * s2, (6 * s - 6 * s2) / L,
                       3 * s2 - 2 * s};
  Eigen::Matrix<double, 6, 12> N = Eigen::Matrix<double, 6, 12>::Zero();
  for (const int along : {0, 3}) {
    N(along, along) = 1 - s;
    N(along, along + 6) = s;
  }
  // v and rz = v'; w and ry = -w', where the rotation is the negative slope.
  const int v[4] = {1, 5, 7, 11}, w[4] = {2, 4, 8, 10};
  for (int k = 0; k < 4; ++k) {
    const double sign = k % 2 == 0 ? 1.0 : -1.0;
    N(1, v[k]) = h[k];
    N(5, v[k]) = d[k];
    N(2, w[k]) = sign * h[k];
    N(4, w[k]) = -sign * d[k];
  }
  return N;
}

}  // namespace

std::optional<BarChains> BarChains::make(const FeModel& model, const SparseMatrix& K,
                                         const SparseMatrix& M, const std::vector<int>& boundary,
                                         const std::vector<int>& zero,
                                         const std::function<std::string(int)>& label) {
  const std::size_t n = model.elements.size();
  if (n <= few_elements || model.dofs_per_node() != 6 || !model.springs.empty())
    return std::nullopt;
  for (const FeElement& e : model.elements)
    if (e.type != FeElementType::beam2) return std::nullopt;
  std::vector<char> kept(model.positions.size(), 0);
  for (const auto* list : {&boundary, &zero})
    for (const int dof : *list) kept[dof / 6] = 1;
  std::size_t beams = 0;
  for (const Chain& chain : chains_of(model, kept)) {
    for (const std::size_t place : cuts(chain, n)) kept[chain.nodes[place]] = 1;
    beams += cuts(chain, n).size() - 1;
  }
  if (2 * beams > n) return std::nullopt;
  return BarChains(model, K, M, boundary, zero, label, kept);
}

BarChains::BarChains(const FeModel& model, const SparseMatrix& K, const SparseMatrix& M,
                     const std::vector<int>& boundary, const std::vector<int>& zero,
                     const std::function<std::string(int)>& label, const std::vector<char>& kept)
    : size_(static_cast<int>(K.rows())),
      coarse_factors_(SparseMatrix(0, 0)),
      inside_factors_(SparseMatrix(0, 0)) {
  // The frame of long beams.
  FeModel coarse;
  coarse.materials = model.materials;
  coarse.sections = model.sections;
  std::vector<int> new_of(model.positions.size(), -1), old_of;
  for (std::size_t k = 0; k < kept.size(); ++k) {
    if (kept[k] == 0) continue;
    new_of[k] = static_cast<int>(old_of.size());
    old_of.push_back(static_cast<int>(k));
    coarse.positions.push_back(model.positions[k]);
  }
  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t c = 0; c < old_of.size(); ++c)
    for (int i = 0; i < 6; ++i)
      entries.emplace_back(6 * old_of[c] + i, 6 * static_cast<int>(c) + i, 1.0);
  for (const Chain& chain : chains_of(model, kept)) {
    FeElement beam = model.elements[chain.first_element];
    const std::size_t n = chain.nodes.size() - 1;
    beam.nodes[0] = new_of[chain.nodes.front()];
    beam.nodes[1] = new_of[chain.nodes.back()];
    coarse.elements.push_back(beam);
    const ElementInput in = gather(coarse, beam);
    const double L = (in.p[1] - in.p[0]).norm();
    const Mat3 T = beam_axes(in);
    for (std::size_t k = 1; k < n; ++k) {
      const auto N = interpolation(static_cast<double>(k) / static_cast<double>(n), L);
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 4; ++b) {
          const Mat3 block = T * N.block<3, 3>(3 * a, 3 * b) * T.transpose();
          const int column = 6 * beam.nodes[b / 2] + 3 * (b % 2);
          for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
              if (block(i, j) != 0.0)
                entries.emplace_back(6 * chain.nodes[k] + 3 * a + i, column + j, block(i, j));
        }
    }
  }
  P_.resize(size_, 6 * static_cast<Eigen::Index>(old_of.size()));
  P_.setFromTriplets(entries.begin(), entries.end());

  std::vector<char> held(size_, 0);
  for (const auto* list : {&boundary, &zero})
    for (const int dof : *list) held[dof] = 1;
  const auto coarse_dof = [&](int dof) { return 6 * new_of[dof / 6] + dof % 6; };
  std::vector<int> coarse_inner, coarse_boundary, coarse_zero, inside;
  for (int dof = 0; dof < size_; ++dof) {
    if (held[dof] != 0) continue;
    const bool is_kept = kept[dof / 6] != 0;
    if (is_kept) coarse_inner.push_back(coarse_dof(dof));
    if (!is_kept) inside_.push_back(static_cast<int>(inner_.size())), inside.push_back(dof);
    inner_.push_back(dof);
  }
  for (const int dof : boundary) coarse_boundary.push_back(coarse_dof(dof));
  for (const int dof : zero) coarse_zero.push_back(coarse_dof(dof));
  P_inner_ = pick(P_, inner_, coarse_inner);
  M_inner_ = pick(M, inner_, inner_);
  const SparseMatrix K_c = assemble_stiffness(coarse);
  const SparseMatrix no_mass(K_c.rows(), K_c.cols());
  coarse_.emplace(K_c, no_mass, coarse_boundary, coarse_zero,
                  [&](int dof) { return label(6 * old_of[dof / 6] + dof % 6); });
  coarse_factors_ = SparseFactors(pick(K_c, coarse_inner, coarse_inner));
  inside_factors_ = SparseFactors(pick(K, inside, inside));
}

MatX BarChains::solve(const MatX& f) const {
  const MatX f_c = P_inner_.transpose() * f;
  MatX x = P_inner_ * coarse_factors_.solve(f_c);
  x(inside_, Eigen::all) += inside_factors_.solve(f(inside_, Eigen::all));
  return x;
}

MatX BarChains::constraint_modes() const { return P_ * coarse_->constraint_modes(); }

MatX BarChains::guyan_stiffness(const MatX&) const {
  return coarse_->guyan_stiffness(coarse_->constraint_modes());
}

MatX BarChains::inner_response(const MatX& forces) const {
  MatX x = MatX::Zero(size_, forces.cols());
  x(inner_, Eigen::all) = solve(forces(inner_, Eigen::all));
  return x;
}

Eigenmodes BarChains::lowest(int count) const {
  return lowest_modes([this](const MatX& f) { return solve(f); }, M_inner_, count);
}

Eigenmodes BarChains::normal_modes(int count) const {
  Eigenmodes modes = inner_modes(count, inner(), [this](int n) { return lowest(n); });
  MatX shapes = MatX::Zero(size_, modes.shapes.cols());
  shapes(inner_, Eigen::all) = modes.shapes;
  modes.shapes = std::move(shapes);
  return modes;
}

int BarChains::count_below(double frequency) const {
  const double omega = omega_of(frequency);
  // Sylvester's law needs factors of K - w^2 M, which have no accurate digits here: modes are
  // computed until one is above.
  for (int count = 16;; count *= 2) {
    count = std::min(count, inner());
    const Eigenmodes modes = lowest(count);
    const auto below = static_cast<int>((modes.omega.array() < omega).count());
    if (below < modes.omega.size() || modes.omega.size() < count || count == inner()) return below;
  }
}

}  // namespace floatframe
