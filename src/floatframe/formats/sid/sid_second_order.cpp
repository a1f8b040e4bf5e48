#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "floatframe/formats/sid/sid_content.hpp"

namespace floatframe {
namespace {

constexpr double same_digits = 1e-6;    // numbers of a file have 12 digits
constexpr double inertia_alone = 0.05;  // lumped masses of some writers against consistent ones
constexpr int pairs_of_cross[3][2] = {{1, 2}, {2, 0}, {0, 1}};

using Moments = std::array<std::array<MatX, 3>, 3>;

Moments no_moments(int nq) {
  Moments m;
  for (auto& row : m) row.fill(MatX::Zero(nq, nq));
  return m;
}

/// 0 1 -> 0, 1 2 -> 1, 0 2 -> 2: the pair's place in Oe behind the squares.
std::size_t pair_of(std::size_t i, std::size_t j) { return i + j == 1 ? 0 : i + j == 3 ? 1 : 2; }

class SecondOrderOfSid {
 public:
  SecondOrderOfSid(const SidContent& content, const MatX& Me, FlexibleBody& body,
                   const std::function<void(int, const std::string&)>& note)
      : c_(content), nq_(content.modes), Me_(Me), body_(body), note_(note) {}

  void read() {
    differences();
    sums();
    const double off = (trace_ - Me_).norm() / std::max(Me_.norm(), 1e-300);
    const bool inertia = c_.Oe.first_order() && off <= inertia_alone;
    const bool stiffened = in_frames() || c_.Ct.first_order() || (c_.Oe.first_order() && !inertia);
    Moments& S = body_.invariants.Sij;
    const std::optional<Moments> known = stiffened ? of_Gr() : std::nullopt;
    if (known) {
      S = *known;
    } else {
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j) {
          if (i == j)
            S[i][i] = inertia ? MatX(0.5 * sum(i, i) + (Me_ - trace_) / 3.0) : MatX(Me_ / 3.0);
          else
            S[i][j] = 0.5 * (odd(i, j) + (inertia ? sum(i, j) : MatX(MatX::Zero(nq_, nq_))));
        }
    }
    if (stiffened)
      second_order();
    else if (even_share_ > same_digits)
      note_(from_Ge_ ? c_.Ge.line : c_.Cr.line,
            fmt::format("the terms of {} of two modes must change sign when the modes are "
                        "exchanged; a part of {:.2g} of the modal mass that does not is left out",
                        from_Ge_ ? "Ge" : "m1 of Cr", even_share_));
    if (!known) notes(inertia, off);
  }

 private:
  bool in_frames() const {
    return std::any_of(c_.frames.begin(), c_.frames.end(), [](const SidFrame& f) {
      return f.phi.first_order() || f.psi.first_order();
    });
  }

  /// int phi_l x phi_k dm, component a, as (l, k): antisymmetric of S^ij, symmetric of S2i.
  void differences() {
    odd_.fill(MatX::Zero(nq_, nq_));
    even_ = odd_;
    from_Ge_ = c_.Cr.m1.empty();
    double most = 0.0, rest = 0.0;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto column = static_cast<Eigen::Index>(a);
      MatX d(nq_, nq_);
      for (int l = 0; l < nq_; ++l)
        for (int k = 0; k < nq_; ++k)
          d(l, k) = from_Ge_ ? 0.5 * c_.Ge.m0(k, 3 * l + column) : c_.Cr.m1[l](k, column);
      odd_[a] = 0.5 * (d - d.transpose());
      even_[a] = 0.5 * (d + d.transpose());
      most = std::max(most, odd_[a].cwiseAbs().maxCoeff());
      rest = std::max(rest, even_[a].cwiseAbs().maxCoeff());
    }
    even_share_ = rest / std::max({most, Me_.cwiseAbs().maxCoeff(), 1e-300});
  }

  /// t_ij + t_ji of Oe m1, symmetric part in the modes.
  void sums() {
    std::array<MatX, 6> O;
    O.fill(MatX::Zero(nq_, nq_));
    for (std::size_t a = 0; a < 6 && !c_.Oe.m1.empty(); ++a) {
      for (int l = 0; l < nq_; ++l)
        O[a].row(l) = c_.Oe.m1[l].col(static_cast<Eigen::Index>(a)).transpose();
      O[a] = 0.5 * (O[a] + O[a].transpose()).eval();
    }
    trace_ = -0.5 * (O[0] + O[1] + O[2]);
    for (std::size_t a = 0; a < 3; ++a) {
      sums_[a] = 2.0 * (trace_ + O[a]);
      sums_[3 + a] = O[3 + a];
    }
  }

  const MatX& sum(std::size_t i, std::size_t j) const {
    return sums_[i == j ? i : 3 + pair_of(i, j)];
  }
  /// S^ij - S^ji.
  MatX odd(std::size_t i, std::size_t j) const {
    const std::size_t a = 3 - i - j;
    return (j == (i + 1) % 3 ? 1.0 : -1.0) * odd_[a];
  }

  /// S^ij if Gr has its terms of first order and they are those of inertia alone.
  std::optional<Moments> of_Gr() const {
    if (!c_.Gr.first_order()) return std::nullopt;
    Moments S = no_moments(nq_);
    for (int l = 0; l < nq_; ++l)
      for (int k = 0; k < nq_; ++k) {
        const Mat3 G = 0.5 * c_.Gr.m1[l].middleCols<3>(3 * k);
        const Mat3 t = (0.5 * G.trace() * Mat3::Identity() - G).transpose();
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j) S[i][j](l, k) = t(i, j);
      }
    const double scale = same_digits * Me_.norm();
    bool good = (S[0][0] + S[1][1] + S[2][2] - Me_).norm() <= scale;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        good = good && (S[i][j] - S[j][i].transpose()).norm() <= scale;
        if (i != j) good = good && (S[i][j] - S[j][i] - odd(i, j)).norm() <= scale;
        S[i][j] = (0.5 * (S[i][j] + S[j][i].transpose())).eval();
        if (i != j) S[j][i] = S[i][j].transpose();
      }
    return good ? std::optional(S) : std::nullopt;
  }

  void second_order() {
    auto out = std::make_shared<SecondOrder>(SecondOrder::zero(nq_));
    const Moments& S = body_.invariants.Sij;
    double off = 0.0, scale = 0.0;
    const auto symmetric = [&](const MatX& m) {
      off = std::max(off, 0.5 * (m - m.transpose()).cwiseAbs().maxCoeff());
      scale = std::max(scale, m.cwiseAbs().maxCoeff());
      return MatX(0.5 * (m + m.transpose()));
    };
    for (std::size_t j = 0; j < 3; ++j) {
      out->S2[j] = symmetric(row_of(c_.Ct, static_cast<Eigen::Index>(j), true));
      for (std::size_t i = 0; i < 3 && c_.Oe.first_order(); ++i)
        out->S2i[i][j] = 0.5 * (sum(i, j) - S[i][j] - S[j][i]);
    }
    for (std::size_t a = 0; a < 3 && !from_Ge_; ++a) {
      const auto [i, j] = pairs_of_cross[a];
      out->S2i[i][j] += 0.5 * even_[a];
      out->S2i[j][i] -= 0.5 * even_[a];
    }
    for (auto& row : out->S2i)
      for (MatX& m : row) m = (0.5 * (m + m.transpose())).eval();
    for (std::size_t f = 0; f < c_.frames.size(); ++f) {
      const SidFrame& frame = c_.frames[f];
      if (frame.phi.m1.empty() && frame.psi.m1.empty()) continue;
      SecondOrderNode& node = out->nodes.emplace_back();
      node.node = static_cast<int>(f);
      for (std::size_t j = 0; j < 3; ++j) {
        node.h[j] = symmetric(row_of(frame.phi, static_cast<Eigen::Index>(j), false));
        node.theta[j] = symmetric(row_of(frame.psi, static_cast<Eigen::Index>(j), false));
      }
    }
    if (off > same_digits * scale)
      note_(0, fmt::format("terms of first order in Ct, phi or psi must be symmetric in the modes; "
                           "a part of {:.2g} of them is left out",
                           off / scale));
    body_.second_order = std::move(out);
  }

  /// m1 of a row (or column) of a block as (l, k).
  MatX row_of(const SidTaylor& block, Eigen::Index j, bool of_columns) const {
    MatX m = MatX::Zero(nq_, nq_);
    for (std::size_t l = 0; l < block.m1.size(); ++l) {
      const auto row = static_cast<Eigen::Index>(l);
      if (of_columns)
        m.row(row) = block.m1[l].col(j).transpose();
      else
        m.row(row) = block.m1[l].row(j);
    }
    return m;
  }

  void notes(bool inertia, double off) const {
    if (inertia && off > same_digits)
      note_(c_.Oe.line,
            fmt::format("second-order inertia terms are taken from m1 of Oe, which gives the modal "
                        "masses with a deviation of {:.2g} from Me; Me is kept",
                        off));
    else if (!inertia)
      note_(c_.Oe.first_order() ? c_.Oe.line : c_.Me.line,
            std::string(c_.Oe.first_order()
                            ? fmt::format("m1 of Oe does not give the modal masses (deviation "
                                          "{:.2g} from Me), so it holds more than inertia: "
                                          "geometric stiffening, whose sum with inertia is kept. ",
                                          off)
                            : "") +
                "The file has no second-order inertia terms: the mass matrix at zero deformation "
                "and its first derivative are exact, its second derivative and softening by spin "
                "are not (S^11, S^22 and S^33 are each taken as a third of Me)");
  }

  const SidContent& c_;
  int nq_;
  const MatX& Me_;
  FlexibleBody& body_;
  const std::function<void(int, const std::string&)>& note_;
  std::array<MatX, 3> odd_, even_;
  std::array<MatX, 6> sums_;  ///< 11 22 33 12 23 13
  MatX trace_;
  double even_share_ = 0.0;
  bool from_Ge_ = false;
};

}  // namespace

void sid_second_order(const SidContent& content, const MatX& Me, FlexibleBody& body,
                      const std::function<void(int, const std::string&)>& note) {
  SecondOrderOfSid(content, Me, body, note).read();
}

void add_sid_second_order(const FlexibleBody& body, SidContent& c) {
  const int nq = c.modes;
  if (nq == 0 || !(body.second_order || body.turning)) return;
  SecondOrder s = body.second_order ? *body.second_order : SecondOrder::zero(nq);
  if (body.turning) {
    for (std::size_t j = 0; j < 3; ++j) {
      s.S2[j] += body.turning->S2[j];
      for (std::size_t i = 0; i < 3; ++i) s.S2i[i][j] += body.turning->S2i[i][j];
    }
  }
  c.Ct.m1.assign(nq, MatX::Zero(nq, 3));
  c.Gr.m1.assign(nq, MatX::Zero(3, 3 * nq));
  for (int l = 0; l < nq; ++l) {
    for (int k = 0; k < nq; ++k) {
      const Mat3 h = sid_moments(s.S2i, l, k);
      c.Gr.m1[l].middleCols<3>(3 * k) = sid_gyroscopic(sid_moments(body.invariants.Sij, l, k));
      for (int a = 0; a < 3; ++a) c.Ct.m1[l](k, a) = s.S2[a](l, k);
      c.Oe.m1[l].row(k) += sid_centrifugal(h);
      c.Cr.m1[l].row(k) += sid_cross(h).transpose();
    }
  }
  for (const SecondOrderNode& node : s.nodes) {
    SidFrame& frame = c.frames.at(static_cast<std::size_t>(node.node));
    frame.phi.m1.assign(nq, MatX::Zero(3, nq));
    frame.psi.m1.assign(nq, MatX::Zero(3, nq));
    for (int l = 0; l < nq; ++l)
      for (int j = 0; j < 3; ++j) {
        frame.phi.m1[l].row(j) = node.h[j].row(l);
        frame.psi.m1[l].row(j) = node.theta[j].row(l);
      }
  }
}

}  // namespace floatframe
