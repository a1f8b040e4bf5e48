// The blocks of a body, and their text: one item per line, D exponents, zeros omitted.
#include "floatframe/formats/sid/sid_content.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "floatframe/body/modal_mass.hpp"
#include "floatframe/core/diagnostics.hpp"
#include "floatframe/math/frequency.hpp"
#include "floatframe/math/so3.hpp"

namespace floatframe {
namespace {

void inertia_blocks(const InertiaInvariants& v, SidContent& c) {
  const int nq = v.modes();
  c.mass = v.m;
  c.mdCM.m0 = v.m_u;
  const Mat3 J = v.inertia_about_origin();
  for (int a = 0; a < 3; ++a) {
    c.J.m0(a, 0) = J(a, a);
    c.J.m0(3 + a, 0) = J(sid_pairs_of_J[a][0], sid_pairs_of_J[a][1]);
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
      const auto [i, j] = sid_pairs_of_J[a];
      c.J.m1[q](3 + a, 0) = -(s(i, j) + s(j, i));
    }
    c.Cr.m0.row(k) = sid_cross(s).transpose();
    c.Gr.m0.middleCols<3>(3 * k) = sid_gyroscopic(s);
    c.Oe.m0.row(k) = sid_centrifugal(s);
    for (int l = 0; l < nq; ++l) {
      const Mat3 t = sid_moments(v.Sij, l, k);
      const std::size_t p = l;
      c.Cr.m1[p].row(k) = sid_cross(t).transpose();
      c.Ge.m0.block<1, 3>(k, 3 * l) = 2.0 * c.Cr.m1[p].row(k);
      c.Oe.m1[p].row(k) = sid_centrifugal(t);
    }
  }
}

/// The name of the node if all names are different numbers, else a running number.
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

using Out = fmt::memory_buffer;

void line(Out& out, int indent, const std::string& key, const std::string& value) {
  fmt::format_to(std::back_inserter(out), "{:{}}{:<{}}= {}\n", "", indent, key, 48 - indent, value);
}

std::string real(double x, const char* block) {
  if (!std::isfinite(x))
    throw InputError(
        ErrorCode::not_finite,
        fmt::format("block {} holds a number that is not finite; a SID file cannot hold it",
                    block));
  std::string text = fmt::format("{:23.16E}", x);
  std::replace(text.begin(), text.end(), 'E', 'D');
  return text;
}

/// 0 zero, 1 diagonal, 2 symmetric, 3 full, 4 unit matrix.
int structure_of(const SidTaylor& t) {
  const MatX& m = t.m0;
  if (t.first_order()) return 3;
  if (m.size() == 0 || m.isZero(0.0)) return 0;
  if (m.rows() != m.cols()) return 3;
  if (m == MatX::Identity(m.rows(), m.cols())) return 4;
  if (m == MatX(m.diagonal().asDiagonal())) return 1;
  return m == m.transpose() ? 2 : 3;
}

void block(Out& out, int indent, const char* name, const SidTaylor& t, int modes) {
  fmt::format_to(std::back_inserter(out), "{:{}}{}\n", "", indent, name);
  const int inner = 26, structure = structure_of(t);
  const std::pair<const char*, Eigen::Index> head[] = {{"order", t.m1.empty() ? 0 : 1},
                                                       {"nrow", t.m0.rows()},
                                                       {"ncol", t.m0.cols()},
                                                       {"nq", modes},
                                                       {"nqn", 0},
                                                       {"structure", structure}};
  for (const auto& [key, value] : head) line(out, inner, key, fmt::format("{:4}", value));
  if (structure != 0 && structure != 4) {
    const auto entry = [&](const std::string& key, double value) {
      if (value != 0.0) line(out, inner, key, real(value, name));
    };
    for (Eigen::Index r = 0; r < t.m0.rows(); ++r)
      for (Eigen::Index c = 0; c < t.m0.cols(); ++c)
        entry(fmt::format("m0({:2},{:2})", r + 1, c + 1), t.m0(r, c));
    for (Eigen::Index c = 0; c < t.m0.cols(); ++c)
      for (Eigen::Index r = 0; r < t.m0.rows(); ++r)
        for (std::size_t q = 0; q < t.m1.size(); ++q)
          entry(fmt::format("m1({:2},{:2},{:2})", r + 1, q + 1, c + 1), t.m1[q](r, c));
  }
  fmt::format_to(std::back_inserter(out), "{:{}}end {}\n", "", indent, name);
}

void frames(Out& out, const SidContent& c) {
  const auto put = [&out](const char* text) {
    fmt::format_to(std::back_inserter(out), "{}\n", text);
  };
  put("           frame");
  for (const SidFrame& f : c.frames) {
    line(out, 16, "new node", f.node);
    line(out, 21, "rframe", "body ref");
    for (const auto& b : sid_frame_blocks) block(out, 21, b.name, f.*b.block, c.modes);
    put("                end node");
  }
  put("           end frame");
}

}  // namespace

Eigen::Matrix<double, 1, 6> sid_centrifugal(const Mat3& s) {
  Eigen::Matrix<double, 1, 6> row;
  for (int a = 0; a < 3; ++a) {
    const auto [i, j] = sid_pairs_of_Oe[a];
    row(a) = s(a, a) - s.trace();
    row(3 + a) = s(i, j) + s(j, i);
  }
  return row;
}

Vec3 sid_cross(const Mat3& s) { return {s(1, 2) - s(2, 1), s(2, 0) - s(0, 2), s(0, 1) - s(1, 0)}; }

Mat3 sid_gyroscopic(const Mat3& s) { return 2.0 * (s.trace() * Mat3::Identity() - s.transpose()); }

Mat3 sid_moments(const std::array<std::array<MatX, 3>, 3>& S, int l, int k) {
  Mat3 t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t(i, j) = S[i][j](l, k);
  return t;
}

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

std::string sid_text(const SidContent& c) {
  Out out;
  std::string comment = c.comment;
  std::replace_if(
      comment.begin(), comment.end(), [](unsigned char ch) { return ch < 32; }, ' ');
  fmt::format_to(std::back_inserter(out), "{:5}{:4}    :No. nodes, No. modes: {}\n part\n",
                 c.frames.size(), c.modes, comment);
  line(out, 6, "new modal", "");
  fmt::format_to(std::back_inserter(out), "           refmod\n");
  line(out, 16, "mass", real(c.mass, "refmod"));
  line(out, 16, "nelastq", fmt::format("{:4}", c.modes));
  for (std::size_t k = 0; k < c.mode_names.size(); ++k)
    line(out, 16, fmt::format("ielastq ({:4})", k + 1), c.mode_names[k]);
  fmt::format_to(std::back_inserter(out), "           end refmod\n");
  frames(out, c);
  for (const auto& b : sid_modal_blocks) block(out, 11, b.name, c.*b.block, c.modes);
  fmt::format_to(std::back_inserter(out), "      end modal\n end part\n");
  return fmt::to_string(out);
}

std::string write_sid(const FlexibleBody& body, const std::string& comment) {
  SidContent content = sid_content(body);
  content.comment = comment + content.comment;
  return sid_text(content);
}

}  // namespace floatframe
