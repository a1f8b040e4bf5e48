#include "floatframe/body/check_invariants.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {
namespace {

constexpr double rounding = 1e-6;          // of numbers written with seven digits
constexpr double cancelled = 1e-11;        // remainder of P_u with a distant centre
constexpr double least_stiffness = 1e-13;  // K scaled to a unit diagonal

double largest(const MatX& m) { return m.size() > 0 ? m.cwiseAbs().maxCoeff() : 0.0; }

double smallest_eigenvalue(const MatX& m) {
  if (m.rows() == 0) return 0.0;
  return symmetric_eigenvalues(m)(0);
}

/// 1 / sqrt of the diagonal; 0 where that is not positive.
VecX to_unit(const VecX& diagonal) {
  return diagonal.unaryExpr([](double x) { return x > 0.0 ? 1.0 / std::sqrt(x) : 0.0; });
}

class Check {
 public:
  Check(const FlexibleBody& body, InvariantSource source)
      : b_(body), v_(body.invariants), nm_(body.modes()), source_(source) {}

  std::vector<InvariantError> run() {
    if (!sizes_fit()) return {};
    if (!finite()) return errors_;
    mass();
    second_moments();
    modal_mass();
    stiffness();
    damping();
    // The whole only if its parts are valid: one cause, one sentence.
    if (errors_.empty()) together();
    return errors_;
  }

 private:
  void add(const std::string& quantity, const std::string& sentence) {
    errors_.push_back({quantity, sentence});
  }

  bool sizes_fit() const {
    bool fit = b_.K.rows() == nm_ && b_.K.cols() == nm_;
    fit = fit && (b_.D.size() == 0 || (b_.D.rows() == nm_ && b_.D.cols() == nm_));
    for (std::size_t i = 0; i < 3; ++i) {
      fit = fit && v_.Si[i].cols() == nm_;
      for (const MatX& s : v_.Sij[i]) fit = fit && s.rows() == nm_ && s.cols() == nm_;
    }
    return fit;
  }

  bool finite() {
    const auto look = [&](const std::string& name, const MatX& x) {
      if (!x.allFinite()) add(name, "found a number that is not finite");
    };
    look("m", MatX::Constant(1, 1, v_.m));
    look("m_u", v_.m_u);
    look("P_u", v_.P_u);
    look("S", v_.S);
    for (std::size_t i = 0; i < 3; ++i) {
      look(fmt::format("S{}", i + 1), v_.Si[i]);
      for (std::size_t j = 0; j < 3; ++j) look(fmt::format("S{}{}", i + 1, j + 1), v_.Sij[i][j]);
    }
    look("K", b_.K);
    look("D", b_.D);
    return errors_.empty();
  }

  bool symmetric(const std::string& name, const MatX& m, double scale) {
    if (m.rows() == 0 || largest(m - m.transpose()) <= rounding * scale) return true;
    Eigen::Index i = 0, j = 0;
    (m - m.transpose()).cwiseAbs().maxCoeff(&i, &j);
    add(name, fmt::format("found {:g} in row {}, column {} and {:g} in row {}, column {}, expected "
                          "a symmetric matrix",
                          m(i, j), i + 1, j + 1, m(j, i), j + 1, i + 1));
    return false;
  }

  void mass() {
    if (!(v_.m > 0.0)) add("m", fmt::format("found {:g}, expected a positive mass [kg]", v_.m));
  }

  void second_moments() {
    if (!symmetric("P_u", v_.P_u, largest(v_.P_u)) || !(v_.m > 0.0)) return;
    const double all = v_.P_u.trace();
    if (nm_ > 0 && !(all > 0.0)) {
      add("P_u",
          fmt::format("found {}, expected the second moments of a body with {:g} kg [kg m2]",
                      largest(v_.P_u) == 0.0 ? "zeros" : fmt::format("the trace {:g}", all), v_.m));
      return;
    }
    const Mat3 P_c = v_.P_u - v_.m_u * v_.m_u.transpose() / v_.m;
    const double least = smallest_eigenvalue(0.5 * (P_c + P_c.transpose()));
    if (least < -rounding * std::max(P_c.trace(), 0.0) - cancelled * std::abs(all))
      add("P_u", fmt::format("found second moments about the centre of mass down to {:.4g} kg m2, "
                             "expected none below zero (P_u, m_u and m must be of one body)",
                             least));
  }

  void modal_mass() {
    if (nm_ == 0) return;
    M_ff_ = floatframe::modal_mass(v_);
    double scale = 0.0;
    for (const auto& row : v_.Sij)
      for (const MatX& s : row) scale = std::max(scale, largest(s));
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if (largest(v_.Sij[i][j] - v_.Sij[j][i].transpose()) > rounding * scale)
          add(fmt::format("S{}{}", i + 1, j + 1),
              fmt::format("found another matrix than the transpose of S{}{}, expected the same",
                          j + 1, i + 1));
    if (!errors_.empty()) return;
    if (source_ != InvariantSource::parameters && scale == 0.0) {
      add("S11", "found zeros as in S22 and S33, expected modes that move mass");
      return;
    }
    unit_ = to_unit(M_ff_.diagonal());
    if (source_ != InvariantSource::integrals) {
      if (symmetric("S11", M_ff_, scale)) positive("S11 + S22 + S33", M_ff_);
      return;
    }
    for (std::size_t i = 0; i < 3; ++i) {
      const std::string name = fmt::format("S{}{}", i + 1, i + 1);
      if (symmetric(name, v_.Sij[i][i], scale)) positive(name, v_.Sij[i][i]);
    }
  }

  /// A part of the modal mass.
  void positive(const std::string& name, const MatX& share) {
    for (Eigen::Index k = 0; k < nm_; ++k) {
      if (!(share(k, k) < -rounding * std::abs(M_ff_(k, k)))) continue;
      add(name, fmt::format("found the modal mass {:g} of mode {}, expected none below zero",
                            share(k, k), k + 1));
      return;
    }
    const double least = smallest_eigenvalue(unit_.asDiagonal() * share * unit_.asDiagonal());
    if (least < -rounding)
      add(name, fmt::format("found a combination of modes of negative mass ({:.3g} of the modal "
                            "mass), expected none below zero",
                            least));
  }

  void stiffness() {
    if (nm_ == 0 || !symmetric("K", b_.K, largest(b_.K))) return;
    const bool all = source_ != InvariantSource::parameters;  // of stiffness
    for (Eigen::Index k = 0; k < nm_; ++k) {
      if (all ? b_.K(k, k) > 0.0 : b_.K(k, k) >= 0.0) continue;
      add("K", fmt::format("found the stiffness {:g} of mode {}, expected {} (rigid motions are "
                           "not among the modes)",
                           b_.K(k, k), k + 1, all ? "a positive number" : "no negative number"));
      return;
    }
    const VecX unit = to_unit(b_.K.diagonal());
    const double least = smallest_eigenvalue(unit.asDiagonal() * b_.K * unit.asDiagonal());
    if (all ? !(least > least_stiffness) : least < -rounding)
      add("K", fmt::format("found a combination of modes {} (smallest eigenvalue {:.3g} with a "
                           "diagonal of ones), expected a positive definite matrix",
                           least < -least_stiffness ? "of negative stiffness" : "without stiffness",
                           least));
  }

  void damping() {
    if (b_.D.size() == 0 || !symmetric("D", b_.D, largest(b_.D))) return;
    const double least = smallest_eigenvalue(0.5 * (b_.D + b_.D.transpose()));
    if (least < -rounding * largest(b_.D))
      add("D", fmt::format("found a combination of modes that gains energy (smallest eigenvalue "
                           "{:.3g} J s), expected none below zero",
                           least));
  }

  /// M(0), or all of G.
  void together() {
    if (nm_ == 0) return;
    MatX G;
    if (source_ == InvariantSource::integrals) {
      G = MatX::Zero(3 * nm_ + 4, 3 * nm_ + 4);
      const Eigen::Index r = 3 * nm_, one = 3 * nm_ + 3;
      for (Eigen::Index i = 0; i < 3; ++i) {
        const std::size_t a = i;
        for (Eigen::Index j = 0; j < 3; ++j) {
          const std::size_t b = j;
          G.block(i * nm_, j * nm_, nm_, nm_) = v_.Sij[a][b];
          G.block(r + i, j * nm_, 1, nm_) = v_.Si[a].row(j);
          G.block(j * nm_, r + i, nm_, 1) = v_.Si[a].row(j).transpose();
        }
        G.block(one, i * nm_, 1, nm_) = v_.S.row(i);
        G.block(i * nm_, one, nm_, 1) = v_.S.row(i).transpose();
      }
      G.block<3, 3>(r, r) = v_.P_u;
      G.block<3, 1>(r, one) = v_.m_u;
      G.block<1, 3>(one, r) = v_.m_u.transpose();
      G(one, one) = v_.m;
    } else {
      G = mass_matrix_at_rest(v_);
    }
    VecX diagonal = G.diagonal();
    if (source_ == InvariantSource::integrals) {
      // In a direction in which a mode does not move round-off remains, next to products with the
      // other modes that are as small but too large for a unit diagonal.
      for (Eigen::Index k = 0; k < 3 * nm_; ++k) {
        const Eigen::Index mode = k % nm_;
        const double all = diagonal(mode) + diagonal(nm_ + mode) + diagonal(2 * nm_ + mode);
        if (G(k, k) <= cancelled * all) diagonal(k) = 0.0;
      }
    } else {  // remainder of J about the axis of a bar
      for (Eigen::Index k = 3; k < 6; ++k)
        if (diagonal(k) <= cancelled * diagonal.segment<3>(3).sum()) diagonal(k) = 0.0;
    }
    const VecX unit = to_unit(diagonal);
    G = (unit.asDiagonal() * G * unit.asDiagonal()).eval();
    G.diagonal().array() += rounding;
    if (is_positive_definite(G)) return;
    const double least = smallest_eigenvalue(G) - rounding;
    if (source_ == InvariantSource::integrals)
      add("S", fmt::format("the integrals m, m_u, P_u, S, S1 to S3 and S11 to S33 contradict each "
                           "other: no distribution of mass has them (smallest eigenvalue {:.3g} "
                           "with a diagonal of ones, expected none below zero)",
                           least));
    else
      add("S", fmt::format("the mass matrix at zero deformation is not positive: with a diagonal "
                           "of ones its smallest eigenvalue is {:.3g}; m, m_u, P_u, S, S1 to S3 "
                           "and S11 to S33 contradict each other",
                           least));
  }

  const FlexibleBody& b_;
  const InertiaInvariants& v_;
  Eigen::Index nm_;
  InvariantSource source_;
  MatX M_ff_;
  VecX unit_;
  std::vector<InvariantError> errors_;
};

}  // namespace

std::vector<InvariantError> check_invariants(const FlexibleBody& body, InvariantSource source) {
  return Check(body, source).run();
}

}  // namespace floatframe
