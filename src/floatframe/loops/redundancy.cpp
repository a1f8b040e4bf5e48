#include "floatframe/loops/redundancy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "floatframe/loops/singular_position.hpp"
#include "floatframe/math/dense.hpp"

namespace floatframe {

namespace {

/// Rows closer than this to the span of those before them count as dependent.
constexpr double dependent = 1e-9;

/// "x", "-y" is "y", "[0.6, 0, 0.8]": a line, without a sense.
std::string line_text(const Vec3& direction) {
  Vec3 n = direction.normalized();
  Eigen::Index main = 0;
  n.cwiseAbs().maxCoeff(&main);
  if (n[main] < 0.0) n = -n;
  if (n[main] > 1.0 - 1e-9) return std::string(1, "xyz"[main]);
  const auto number = [](double x) {
    return fmt::format("{:.4g}", std::round(x * 1e4) / 1e4 + 0.0);
  };
  return fmt::format("[{}, {}, {}]", number(n.x()), number(n.y()), number(n.z()));
}

std::string direction_text(const ConstraintPart& part, const ConstraintRow& row) {
  const ConstraintKind& kind = constraint_kind(part.type);
  if (kind.holds) return kind.holds;
  if (!kind.points) return "rotation about " + line_text(row.gradient.b.T);
  return "translation along " + line_text(row.gradient.b.F);
}

/// The motions x of a body, as columns, that satisfy its internal constraints J x = 0.
MatX null_space(const MatX& J) {
  return pivoted_qr(J.transpose()).Q.rightCols(J.cols() - J.rows());
}

/// lambda with J^T lambda = 0, orthonormal columns.
MatX balanced_multipliers(const MatX& J) {
  const PivotedQr qr = pivoted_qr(J, dependent);
  return qr.Q.rightCols(J.rows() - qr.rank);
}

}  // namespace

bool nearly_dependent(const MatX& J) {
  constexpr double nearly = 1e-2;
  return pivoted_rank(J.transpose(), nearly) < pivoted_rank(J.transpose(), dependent);
}

double independence(const MatX& J) {
  const PivotedQr qr = pivoted_qr(J.transpose(), dependent);
  return qr.rank > 0 ? std::abs(qr.diagonal[qr.rank - 1] / qr.diagonal[0]) : 1.0;
}

std::vector<int> dependent_rows(const MatX& J) {
  const SymmetricEigen e = symmetric_eigen(J * J.transpose());
  std::vector<int> rows;
  if (!e.found) return rows;
  const double zero = 1e-13 * e.values[e.values.size() - 1];
  for (Eigen::Index k = 0; k < e.values.size(); ++k) {
    if (e.values[k] < zero) continue;
    const VecX part = e.vectors.col(k).cwiseAbs();
    for (Eigen::Index i = 0; i < part.size(); ++i)
      if (part[i] > 0.3 * part.maxCoeff()) rows.push_back(static_cast<int>(i));
    break;
  }
  return rows;
}

int rank_of(const SparseRowMatrix& J) { return IndependentRows(J, dependent).rank(); }

ConstraintAnalysis::ConstraintAnalysis(RelativeFormulation& tree, const VecX& q)
    : model_(tree.model()), f_(tree.model(), tree.model().simulation.inertia) {
  State state;
  f_.start_from(tree, q, VecX::Zero(tree.velocities()), state.q, state.v);
  kinematics_at(f_, 0.0, state.q, state.v);
  f_.dynamics();
  const Eigen::Index nq = f_.velocities();
  first_ = parts().empty() ? f_.constraints() : f_.constraint_set().offset(0);
  const SparseRowMatrix all = f_.constraint_rows();
  VecX load(nq);
  f_.residual(VecX::Zero(nq), VecX::Zero(f_.constraints()), 0.0, load);
  // Motions of the separate bodies: coordinates and internal constraints of a body follow those of
  // the bodies before it.
  Eigen::Index column = 0, row = 0, motions = 0;
  std::vector<MatX> own_motions;
  std::vector<std::array<Eigen::Index, 2>> first_of(
      static_cast<std::size_t>(nq));  // column, motion
  std::vector<std::size_t> body_of(static_cast<std::size_t>(nq));
  load_ = VecX::Zero(nq - first_);
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const AbsoluteBody& body = f_.kinematics().bodies()[i];
    const Eigen::Index size = body.size(), own = body.rows();
    MatX own_rows = MatX::Zero(own, size);
    for (Eigen::Index r = 0; r < own; ++r)
      for (SparseRowMatrix::InnerIterator it(all, row + r); it; ++it)
        own_rows(r, it.col() - column) = it.value();
    const MatX N = null_space(own_rows);
    load_.segment(motions, N.cols()) = -(N.transpose() * load.segment(column, size));
    for (Eigen::Index k = column; k < column + size; ++k) {
      first_of[static_cast<std::size_t>(k)] = {column, motions};
      body_of[static_cast<std::size_t>(k)] = i;
    }
    own_motions.push_back(N);
    column += size;
    row += own;
    motions += N.cols();
  }
  std::vector<Eigen::Triplet<double>> entries;
  J_.resize(f_.constraints() - first_, nq - first_);
  for (Eigen::Index i = 0; i < J_.rows(); ++i)
    for (SparseRowMatrix::InnerIterator it(all, first_ + i); it; ++it) {
      const auto k = static_cast<std::size_t>(it.col());
      const MatX& N = own_motions[body_of[k]];
      for (Eigen::Index m = 0; m < N.cols(); ++m)
        entries.emplace_back(i, first_of[k][1] + m, it.value() * N(it.col() - first_of[k][0], m));
    }
  J_.setFromTriplets(entries.begin(), entries.end());
}

std::vector<RedundantDirection> ConstraintAnalysis::redundant() const {
  std::vector<RedundantDirection> found;
  const IndependentRows independent(J_, dependent);
  auto next = independent.dependent().begin();
  for (std::size_t k = 0; k < parts().size(); ++k)
    for (; next != independent.dependent().end() && *next < row_of(k) + parts()[k].rows(); ++next)
      if (!holds_motion(k))
        found.push_back({owner_name(model_, parts()[k].owner),
                         direction_text(parts()[k], row(k, *next - row_of(k)))});
  return found;
}

/// A motion that varies, whose row depends on those of joints, rods and couplings, which come
/// first.
bool ConstraintAnalysis::holds_motion(std::size_t part) const {
  const ConstraintPart& p = parts()[part];
  if (!p.is_motion() || !changes(*p.motion, model_.simulation.duration)) return false;
  Eigen::Index others = 0;
  for (std::size_t k = 0; k < parts().size(); ++k)
    if (!parts()[k].is_motion()) others = std::max(others, row_of(k) + parts()[k].rows());
  SparseRowMatrix J(others + 1, J_.cols());
  J.topRows(others) = J_.topRows(others);
  J.bottomRows(1) = J_.middleRows(row_of(part), 1);
  const IndependentRows independent(J, dependent);
  return !independent.dependent().empty() && independent.dependent().back() == others;
}

std::vector<std::string> ConstraintAnalysis::held_motions() const {
  std::vector<std::string> names;
  for (std::size_t k = 0; k < parts().size(); ++k)
    if (holds_motion(k)) names.push_back(model_.joints[parts()[k].owner.joint].name);
  return names;
}

std::optional<BalancedMultipliers> ConstraintAnalysis::multipliers(double residual) const {
  if (J_.rows() == 0 || J_.cols() == 0) return std::nullopt;
  const MatX J(J_);
  BalancedMultipliers found{LeastNorm(J.transpose(), dependent).solve(load_), {}};
  const double error = (J.transpose() * found.lambda - load_).lpNorm<Eigen::Infinity>();
  const double weight = residual + 1e-6 * (1e-6 + load_.lpNorm<Eigen::Infinity>());
  if (!(error < 10.0 * weight)) return std::nullopt;
  found.balanced = balanced_multipliers(J);
  return found;
}

MatX ConstraintAnalysis::balanced() const { return balanced_multipliers(MatX(J_)); }

std::string redundancy_text(const std::vector<RedundantDirection>& redundant) {
  constexpr int most = 5;  // joints or rods
  std::string text;
  int named = 0;
  for (std::size_t k = 0; k < redundant.size(); ++k) {
    const bool same = k > 0 && redundant[k].owner == redundant[k - 1].owner;
    if (!same && ++named > most) {
      return text + fmt::format("; and {} more", redundant.size() - k);
    }
    if (same)
      text += ", " + redundant[k].direction;
    else
      text += (k > 0 ? "; " : "") + redundant[k].owner + ": " + redundant[k].direction;
  }
  return text;
}

void report_redundancy(RelativeFormulation& f, const State& state, StartReport& report) {
  const int nc = f.constraints();
  if (nc == 0 || rank_of(f.constraint_rows()) == nc) return;
  const ConstraintAnalysis analysis(f, state.q);
  report.redundant = analysis.redundant();
  const bool may_be = may_be_singular(f, state.t, state.q);
  kinematics_at(f, state);
  for (const std::string& joint : analysis.held_motions())
    report.notes.push_back(fmt::format(
        "the prescribed motion of joint '{}' moves what other constraints hold still at the start: "
        "they contradict each other as soon as it moves",
        joint));
  const SingularPosition singular = may_be ? singular_position(f) : SingularPosition{};
  const std::string& text = singular.sentence;
  if (!text.empty()) report.notes.push_back("at the start " + text);
  const int n = std::ssize(report.redundant);
  if (n == 0) return;
  const int only_there = std::min(n, singular.only_there);
  if (only_there == n) {
    report.notes.push_back(
        fmt::format("{} on others in this position only ({})",
                    n == 1 ? "1 constraint depends" : fmt::format("{} constraints depend", n),
                    redundancy_text(report.redundant)));
    return;
  }
  report.notes.push_back(fmt::format(
      "{} redundant{} ({}): the motion does not depend on {}, but reactions in these loops are not "
      "unique",
      n == 1 ? "1 constraint is" : fmt::format("{} constraints are", n),
      only_there > 0 ? fmt::format(", {} of them in this position only", only_there) : "",
      redundancy_text(report.redundant), n == 1 ? "it" : "them"));
}

}  // namespace floatframe
