#include "floatframe/formats/sid/sid_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

constexpr int pair_of_column[3][2] = {{0, 1}, {1, 2}, {0, 2}};  // Oe columns 4..6
constexpr int pair_of_J[3][2] = {{0, 1}, {0, 2}, {1, 2}};       // J rows 4..6

/// Row k of Oe from the moments s(i, j) = int r_i phi_kj dm.
Eigen::Matrix<double, 1, 6> centrifugal(const Mat3& s) {
  Eigen::Matrix<double, 1, 6> row;
  for (int a = 0; a < 3; ++a) row(a) = s(a, a) - s.trace();
  for (int c = 0; c < 3; ++c) {
    const auto [a, b] = pair_of_column[c];
    row(3 + c) = s(a, b) + s(b, a);
  }
  return row;
}

/// int r x phi dm from the same moments.
Vec3 moment(const Mat3& s) { return Vec3(s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)); }

void inertia_blocks(const InertiaInvariants& v, SidContent& c) {
  const int nq = v.modes();
  c.mass = v.m;
  c.mdCM.m0 = v.m_u;
  const Mat3 J = v.inertia_about_origin();
  for (int a = 0; a < 3; ++a) {
    c.J.m0(a, 0) = J(a, a);
    c.J.m0(3 + a, 0) = J(pair_of_J[a][0], pair_of_J[a][1]);
  }
  c.Ct.m0 = v.S.transpose();
  const MatX Me = modal_mass(v);
  c.Me.m0 = 0.5 * (Me + Me.transpose());
  for (int k = 0; k < nq; ++k) {
    Mat3 s;  // s(i, j) = int r_i phi_kj dm
    for (int i = 0; i < 3; ++i) s.row(i) = v.Si[i].col(k).transpose();
    const std::size_t q = k;
    c.mdCM.m1[q] = v.S.col(k);
    for (int a = 0; a < 3; ++a) {
      c.J.m1[q](a, 0) = 2.0 * (s.trace() - s(a, a));
      const auto [i, j] = pair_of_J[a];
      c.J.m1[q](3 + a, 0) = -(s(i, j) + s(j, i));
    }
    c.Cr.m0.row(k) = moment(s).transpose();
    c.Gr.m0.middleCols<3>(3 * k) = 2.0 * (s.trace() * Mat3::Identity() - s.transpose());
    c.Oe.m0.row(k) = centrifugal(s);
    for (int l = 0; l < nq; ++l) {
      Mat3 t;  // t(i, j) = int phi_li phi_kj dm
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) t(i, j) = v.Sij[i][j](l, k);
      const std::size_t p = l;
      c.Cr.m1[p].row(k) = moment(t).transpose();
      c.Ge.m0.block<1, 3>(k, 3 * l) = 2.0 * c.Cr.m1[p].row(k);
      c.Oe.m1[p].row(k) = centrifugal(t);
    }
  }
}

/// The node's own name if all names are different numbers, else a running number.
std::vector<std::string> frame_numbers(const std::vector<ModalNode>& nodes) {
  std::set<std::string> used;
  std::vector<std::string> names;
  for (const ModalNode& node : nodes) {
    const bool number = !node.name.empty() && node.name.size() < 10 &&
                        std::all_of(node.name.begin(), node.name.end(),
                                    [](unsigned char c) { return std::isdigit(c) != 0; });
    if (!number || !used.insert(node.name).second) {
      names.clear();
      for (std::size_t i = 1; i <= nodes.size(); ++i) names.push_back(fmt::format("{}", i));
      return names;
    }
    names.push_back(node.name);
  }
  return names;
}

SidFrame frame_of(const ModalNode& node, std::string number, int nq) {
  SidFrame f;
  f.node = std::move(number);
  for (const auto& block : sid_frame_blocks) block.clear(f, nq);
  f.origin.m0 = node.p;
  f.AP.m0.setIdentity();
  if (node.X.cols() == nq) f.phi.m0 = node.X;
  if (node.X_theta.cols() == nq) f.psi.m0 = node.X_theta;
  for (int k = 0; k < nq; ++k) {
    f.origin.m1[k] = f.phi.m0.col(k);
    f.AP.m1[k] = skew(f.psi.m0.col(k));
  }
  return f;
}

std::string mode_label(const FlexibleBody& body, const SidContent& c, int k) {
  const std::size_t i = k;
  const double w2 = c.Me.m0(k, k) > 0.0 ? c.Ke.m0(k, k) / c.Me.m0(k, k) : 0.0;
  const double f = hertz_of_eigenvalue(w2);
  const std::string name = i < body.mode_names.size() && !body.mode_names[i].empty()
                               ? body.mode_names[i]
                               : fmt::format("Eigen Mode {:4}", k + 1);
  return fmt::format("{} : {:12.3f} Hz", name, f);
}

}  // namespace

bool SidTaylor::first_order() const {
  return std::any_of(m1.begin(), m1.end(),
                     [](const MatX& m) { return m.size() > 0 && m.cwiseAbs().maxCoeff() > 0.0; });
}

SidContent sid_content(const FlexibleBody& body) {
  const int nq = body.modes();
  const auto fits = [nq](const MatX& m) { return m.rows() == nq && m.cols() == nq; };
  if (!fits(body.K) || (body.D.size() > 0 && !fits(body.D)))
    throw InputError(
        ErrorCode::wrong_count,
        fmt::format("the body has {} modes, but its stiffness is {} x {} and its damping {} x {}",
                    nq, body.K.rows(), body.K.cols(), body.D.rows(), body.D.cols()));
  SidContent c;
  c.modes = nq;
  for (const auto& block : sid_modal_blocks) block.clear(c, nq);
  inertia_blocks(body.invariants, c);
  c.Ke.m0 = 0.5 * (body.K + body.K.transpose());
  if (body.D.size() > 0) c.De.m0 = 0.5 * (body.D + body.D.transpose());
  for (int k = 0; k < nq; ++k) c.mode_names.push_back(mode_label(body, c, k));
  const std::vector<std::string> numbers = frame_numbers(body.nodes);
  for (std::size_t i = 0; i < body.nodes.size(); ++i) {
    c.frames.push_back(frame_of(body.nodes[i], numbers[i], nq));
    if (numbers[i] != body.nodes[i].name && !body.nodes[i].name.empty() && c.comment.size() < 150)
      c.comment += fmt::format("{} {} = {}", c.comment.empty() ? " Frames:" : ",", numbers[i],
                               body.nodes[i].name);
  }
  add_sid_second_order(body, c);
  return c;
}

}  // namespace floatframe
