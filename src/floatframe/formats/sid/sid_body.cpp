// A body from the blocks of a SID_FEM file; sid_content.hpp has their meaning. Duplicate data are
// compared: mdCM m1 and Ct must agree, the others give notes.
#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formats/sid/sid_content.hpp"
#include "floatframe/formats/text/text_source.hpp"
#include "floatframe/math/dense.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

constexpr double same_in_sid = 1e-6;  // numbers of a file have 12 digits
constexpr double own_digits = 1e-5;   // of a moment of inertia about the centre of mass
constexpr double close = 0.05;        // lumped masses of some writers against consistent ones
/// Component c of a cross product: first(c) x second(c).
constexpr int axes_of_cross[3][2] = {{1, 2}, {2, 0}, {0, 1}};

class BodyOfSid {
 public:
  BodyOfSid(const SidContent& content, const std::string& name)
      : c_(content), nq_(content.modes), name_(name) {}

  SidBody build() {
    InertiaInvariants& v = out_.body.invariants = InertiaInvariants::zero(nq_);
    v.m = c_.mass;
    v.m_u = c_.mdCM.m0;
    const Mat3 J = inertia(c_.J.m0);
    v.P_u = 0.5 * J.trace() * Mat3::Identity() - J;  // (21)
    static_moments(v);
    first_moments(v);
    if (nq_ > 0)
      sid_second_order(c_, symmetric(c_.Me, "Me"), out_.body,
                       [this](int line, const std::string& text) { note(line, "{}", text); });
    out_.body.K = symmetric(c_.Ke, "Ke");
    out_.body.D = symmetric(c_.De, "De");
    out_.body.mode_names = c_.mode_names;
    for (const SidFrame& f : c_.frames) add_node(f);
    left_out();
    if (errors_.empty()) check_inertia(v);
    if (errors_.empty()) check_mass_matrix(v);
    if (errors_.empty()) check_energy();
    errors_.throw_if_any();
    return std::move(out_);
  }

 private:
  SourceMark mark(int line) const { return {name_, line, 0}; }
  template <class... Args>
  void note(int line, fmt::format_string<Args...> text, Args&&... args) {
    out_.notes.push_back(mark(line).before(fmt::format(text, std::forward<Args>(args)...)));
  }
  template <class... Args>
  void error(ErrorCode code, int line, fmt::format_string<Args...> text, Args&&... args) {
    errors_.add(code, mark(line), fmt::format(text, std::forward<Args>(args)...));
  }

  static Mat3 inertia(const MatX& j) {
    Mat3 J = Mat3::Zero();
    if (j.rows() == 3) {
      J = j;
    } else {
      for (int a = 0; a < 3; ++a) {
        J(a, a) = j(a, 0);
        J(sid_pairs_of_J[a][0], sid_pairs_of_J[a][1]) =
            J(sid_pairs_of_J[a][1], sid_pairs_of_J[a][0]) = j(3 + a, 0);
      }
    }
    return 0.5 * (J + J.transpose());
  }

  MatX symmetric(const SidTaylor& block, const char* name) {
    const double scale = block.m0.size() > 0 ? block.m0.cwiseAbs().maxCoeff() : 0.0;
    const double skew = scale > 0.0 ? (block.m0 - block.m0.transpose()).cwiseAbs().maxCoeff() : 0.0;
    if (skew > same_in_sid * scale)
      error(ErrorCode::contradiction, block.line,
            "block {} is not symmetric: entries differ by {:.3g} of the largest", name,
            skew / scale);
    return 0.5 * (block.m0 + block.m0.transpose());
  }

  void static_moments(InertiaInvariants& v) {
    v.S = c_.Ct.m0.transpose();
    if (c_.mdCM.m1.empty()) return;
    for (int k = 0; k < nq_; ++k) {
      const Vec3 m1 = c_.mdCM.m1[k];
      const double scale = std::max(m1.norm(), v.S.norm());
      if ((m1 - v.S.col(k)).norm() > same_in_sid * scale)
        error(ErrorCode::contradiction, c_.Ct.line,
              "row {} of block Ct is ({:.6g} {:.6g} {:.6g}), but m1 of mdCM in line {} is ({:.6g} "
              "{:.6g} {:.6g}): they must be equal",
              k + 1, v.S(0, k), v.S(1, k), v.S(2, k), c_.mdCM.line, m1(0), m1(1), m1(2));
    }
  }

  /// S^i_(j) = int r_i phi_j dm: symmetric sums from J m1 (or Oe), differences from Cr.
  void first_moments(InertiaInvariants& v) {
    const bool from_Oe = c_.J.m1.empty() && nq_ > 0;
    if (from_Oe)
      note(c_.J.line, "{}",
           c_.Oe.line > 0 ? "block J has no first-order terms; they are taken from Oe"
                          : "block J has no first-order terms and there is no Oe: the inertia "
                            "tensor does not change with the deformation");
    double of_Gr = 0.0, of_Oe = 0.0, scale_Gr = 0.0, scale_Oe = 0.0;
    for (int k = 0; k < nq_; ++k) {
      const std::size_t q = k;
      const auto Oe = c_.Oe.m0.row(k);
      Mat3 sum;  // int r_i phi_j + r_j phi_i dm
      if (from_Oe) {
        const double trace = -0.5 * (Oe(0) + Oe(1) + Oe(2));
        for (int a = 0; a < 3; ++a) {
          sum(a, a) = 2.0 * (trace + Oe(a));
          const auto [i, j] = sid_pairs_of_Oe[a];
          sum(i, j) = sum(j, i) = Oe(3 + a);
        }
      } else {
        const Mat3 J1 = inertia(c_.J.m1[q]);
        sum = 0.5 * J1.trace() * Mat3::Identity() - J1;  // of P (21)
      }
      Mat3 s = 0.5 * sum;
      for (int a = 0; a < 3; ++a) {
        const auto [i, j] = axes_of_cross[a];
        s(i, j) += 0.5 * c_.Cr.m0(k, a);
        s(j, i) -= 0.5 * c_.Cr.m0(k, a);
      }
      for (int i = 0; i < 3; ++i) v.Si[i].col(k) = s.row(i).transpose();

      const Mat3 Gr = sid_gyroscopic(s);
      of_Gr = std::max(of_Gr, (c_.Gr.m0.middleCols<3>(3 * k) - Gr).cwiseAbs().maxCoeff());
      scale_Gr = std::max(scale_Gr, Gr.cwiseAbs().maxCoeff());
      of_Oe = std::max(of_Oe, (Oe - sid_centrifugal(s)).cwiseAbs().maxCoeff());
      scale_Oe = std::max(scale_Oe, Oe.cwiseAbs().maxCoeff());
    }
    if (c_.Gr.line > 0 && of_Gr > same_in_sid * scale_Gr)
      note(c_.Gr.line,
           "block Gr differs from what J and Cr imply by {:.2g} of its largest entry; J and Cr are "
           "used",
           of_Gr / scale_Gr);
    if (c_.Oe.line > 0 && !from_Oe && of_Oe > same_in_sid * scale_Oe)
      note(c_.Oe.line,
           "block Oe differs from what J implies by {:.2g} of its largest entry; J is used",
           of_Oe / std::max(scale_Oe, 1e-300));
  }

  void add_node(const SidFrame& f) {
    ModalNode node;
    node.name = f.node;
    node.p = f.origin.m0;
    node.X = f.phi.m0;
    node.X_theta = f.psi.m0;
    if (f.AP.line > 0 && !f.AP.m0.isIdentity(same_in_sid) && !f.AP.m0.isZero(0.0))
      note(f.AP.line,
           "node {} has axes that are turned against the body's (AP); its own orientation is left "
           "out",
           f.node);
    for (std::size_t k = 0; k < f.origin.m1.size(); ++k) {
      const auto column = static_cast<Eigen::Index>(k);
      const double scale = std::max(f.origin.m1[k].norm(), f.phi.m0.norm());
      if ((f.origin.m1[k] - f.phi.m0.col(column)).norm() > same_in_sid * scale) {
        error(
            ErrorCode::contradiction, f.phi.line,
            "column {} of phi of node {} differs from m1 of origin in line {}: they must be equal",
            k + 1, f.node, f.origin.line);
        break;
      }
    }
    out_.body.nodes.push_back(std::move(node));
  }

  void left_out() {
    if (c_.ksigma.m0.size() > 0 && c_.ksigma.m0.cwiseAbs().maxCoeff() > 0.0)
      error(ErrorCode::unsupported, c_.ksigma.line,
            "block ksigma holds forces of an initial stress, which a body cannot have; write the "
            "file about the unstressed state");
    std::string names;
    for (const auto& [block, name] :
         {std::pair{&c_.Me, "Me"}, std::pair{&c_.Ge, "Ge"}, std::pair{&c_.ksigma, "ksigma"},
          std::pair{&c_.Ke, "Ke"}, std::pair{&c_.De, "De"}})
      if (block->first_order()) names += fmt::format("{}{}", names.empty() ? "" : ", ", name);
    if (!names.empty())
      note(0, "terms of first order in {} are left out: a body has none there", names);
  }

  /// Moments of inertia about the centre of mass, which a large distance from the origin may hide.
  void check_inertia(const InertiaInvariants& v) {
    if (!(v.m > 0.0)) return;
    const Mat3 J_c = v.inertia_about_centre();
    const Vec3 moments =
        Eigen::SelfAdjointEigenSolver<Mat3>(J_c, Eigen::EigenvaluesOnly).eigenvalues();
    const double size = moments.cwiseAbs().maxCoeff();
    const double digits = 1e-12 * v.inertia_about_origin().cwiseAbs().maxCoeff();
    if (moments(0) < -own_digits * size - digits)
      return error(
          ErrorCode::out_of_range, c_.J.line,
          "block J gives a moment of inertia of {:.6g} about the centre of mass (with mass and "
          "mdCM), expected none below zero",
          moments(0));
    const double excess = moments(2) - moments(0) - moments(1);
    if (excess <= own_digits * size + digits) return;
    const std::string text = fmt::format(
        "the moments of inertia about the centre of mass are {:.6g}, {:.6g} and {:.6g}: the "
        "largest is more than the sum of the others, which no body has",
        moments(0), moments(1), moments(2));
    if (excess > close * size)
      error(ErrorCode::wrong_value, c_.J.line, "{}", text);
    else
      note(c_.J.line, "{}", text);
  }

  /// Stiffness and damping must not add energy.
  void check_energy() {
    for (const auto& [block, matrix, what] :
         {std::tuple{&c_.Ke, &out_.body.K, "stiffness"}, {&c_.De, &out_.body.D, "damping"}}) {
      if (nq_ == 0) continue;
      const VecX unit =
          matrix->diagonal().unaryExpr([](double x) { return x > 0.0 ? 1.0 / std::sqrt(x) : 0.0; });
      Eigen::Index k = 0;
      const double least =
          matrix->diagonal().minCoeff(&k) < 0.0
              ? (*matrix)(k, k)
              : symmetric_eigenvalues(unit.asDiagonal() * *matrix * unit.asDiagonal())(0);
      if (least < -same_in_sid)
        error(ErrorCode::out_of_range, block->line,
              "block {} holds a negative {} ({:.3g}), expected none below zero",
              block == &c_.Ke ? "Ke" : "De", what, least);
    }
    if (nq_ > 0 && out_.body.K.isZero(0.0))
      note(c_.Ke.line, "the modes have no stiffness: block Ke is missing or zero");
  }

  /// The mass matrix at zero deformation, scaled to a unit diagonal, must not be indefinite.
  void check_mass_matrix(const InertiaInvariants& v) {
    MatX M = MatX::Zero(6 + nq_, 6 + nq_);
    M.topLeftCorner<3, 3>() = v.m * Mat3::Identity();
    M.block<3, 3>(3, 0) = skew(v.m_u);
    M.block<3, 3>(0, 3) = -skew(v.m_u);
    M.block<3, 3>(3, 3) = v.inertia_about_origin();
    M.topRightCorner(3, nq_) = v.S;
    M.bottomLeftCorner(nq_, 3) = v.S.transpose();
    M.block(6, 3, nq_, 3) = c_.Cr.m0;
    M.block(3, 6, 3, nq_) = c_.Cr.m0.transpose();
    for (int i = 0; i < 3; ++i) M.bottomRightCorner(nq_, nq_) += v.Sij[i][i];
    for (int i = 0; i < 6 + nq_; ++i) {
      if (M(i, i) >= 0.0) continue;
      const int line = i < 3 ? c_.mass_line : i < 6 ? c_.J.line : c_.Me.line;
      error(ErrorCode::out_of_range, line,
            "a diagonal entry of the mass matrix is negative: {:.6g}", M(i, i));
      return;
    }
    const VecX d = M.diagonal().cwiseSqrt().cwiseInverse().unaryExpr(
        [](double x) { return std::isfinite(x) ? x : 0.0; });
    const MatX scaled = d.asDiagonal() * M * d.asDiagonal();
    const double least = symmetric_eigenvalues(scaled)(0);
    if (!(least >= -same_in_sid))
      error(ErrorCode::out_of_range, c_.Me.line,
            "the mass matrix at zero deformation is not positive: scaled to a unit diagonal its "
            "smallest eigenvalue is {:.3g}; mass, mdCM, J, Ct, Cr and Me contradict each other",
            least);
  }

  const SidContent& c_;
  int nq_;
  std::string name_;
  SidBody out_;
  ErrorList errors_;
};

}  // namespace

SidBody sid_body(const SidContent& content, const std::string& name) {
  return BodyOfSid(content, name).build();
}

SidBody parse_sid(std::string_view text, const std::string& name) {
  return sid_body(parse_sid_content(text, name), name);
}

SidBody read_sid(const std::filesystem::path& file) {
  return parse_sid(read_whole_file(file), file.string());
}

}  // namespace floatframe
