#pragma once
// The blocks of a SID_FEM file and how they follow from the inertia integrals of a body.
//
// A point moves with v = v_O + w x r + phi qdot in body axes, r = r_u + phi q, phi = X. From the
// kinetic energy 1/2 int v.v dm and the virtual power of the remaining accelerations w x (w x r)
// and 2 w x (phi qdot), with a~ b = a x b and the accelerations (a_O, wdot, qddot):
//
//   [ m I     mc~^T  Ct^T ] [a_O  ]   [ w x (w x mc) + 2 w x (Ct^T qdot)       ]
//   [ mc~     J      Cr^T ] [wdot ] + [ w x J w + (sum_k Gr_k qdot_k) w        ] = forces
//   [ Ct      Cr     Me   ] [qddot]   [ (sum_k Ge_k qdot_k) w + Oe (w w)       ]
//
//   mdCM  3 x 1       mc = int r dm                                    m_u;  m1: S
//   J     6 x 1       int r~^T r~ dm: 11 22 33 12 13 23, J12 = - int x y dm (also read: 3 x 3)
//                     m1: 2 sum_(i != a) S^i_(i) for aa, -(S^a_(b) + S^b_(a)) for ab
//   Ct    nq x 3      int phi^T dm                                     S^T
//   Cr    nq x 3      int phi^T r~^T dm, row k = int r x phi_k dm;     m1(k, l) = int phi_l x phi_k
//   Me    nq x nq     int phi^T phi dm                                 S^11 + S^22 + S^33
//   Gr    3 x 3nq     block k: -2 int r~ phi_k~ dm = 2 (int r.phi_k dm I - int phi_k r^T dm)
//   Ge    nq x 3nq    row k, block l: -2 int phi_k^T phi_l~ dm = 2 Cr m1(k, l)
//   Oe    nq x 6      int phi_k . w x (w x r) dm by w1w1 w2w2 w3w3 w1w2 w2w3 w1w3:
//                     -int (r.phi_k - r_a phi_ka) for aa, int r_a phi_kb + r_b phi_ka for ab;
//                     m1(k, l): the same with phi_l for r
//   origin, phi, psi, AP of a frame: p and m1 = X;  X;  X_theta;  I and m1(q) = skew(X_theta(q))
//
// Signs of Cr, Gr and Oe are those of the file of PY_SID that EMBSlib uses as an example. Indices
// of m1 in the file: (row, mode, column). ksigma is zero, Ke and De are the modal stiffness and
// damping of first order. Displacements of second order add to the first-order terms of Ct, Cr,
// Oe, phi and psi, as below.
#include <array>
#include <functional>
#include <string>
#include <vector>

#include "floatframe/body/flexible_body.hpp"
#include "floatframe/formats/sid/sid_file.hpp"

namespace floatframe {

/// m0 + sum_q m1[q] y_q.
struct SidTaylor {
  MatX m0;
  std::vector<MatX> m1;  ///< one per mode; empty: order 0
  int line = 0;          ///< of the block's name in the file; 0: missing

  SidTaylor() = default;
  SidTaylor(int rows, int columns, int modes_of_m1)
      : m0(MatX::Zero(rows, columns)), m1(modes_of_m1, MatX::Zero(rows, columns)) {}
  bool first_order() const;  ///< is any entry of m1 not zero?
};

struct SidFrame {
  std::string node;
  SidTaylor origin, phi, psi, AP;
};

struct SidContent {
  double mass = 0.0;
  int mass_line = 0;
  int modes = 0;
  std::string comment;
  std::vector<std::string> mode_names;
  std::vector<SidFrame> frames;
  SidTaylor mdCM, J, Ct, Cr, Me, Gr, Ge, Oe, ksigma, Ke, De;
};

/// A block as the file has it, a member of `Owner`: its size is fixed, or so many times the number
/// of modes.
template <class Owner>
struct SidBlock {
  struct Size {
    int fixed = 0, of_modes = 0;
    int with(int modes) const { return fixed + of_modes * modes; }
  };
  enum Need { may_miss, with_modes, always };

  const char* name;
  SidTaylor Owner::*block;
  Size rows, columns;
  bool first_order;  ///< bodies have terms there
  Need needed = may_miss;

  SidTaylor zero(int modes, int modes_of_m1) const {
    return {rows.with(modes), columns.with(modes), modes_of_m1};
  }
  /// Of a body.
  void clear(Owner& owner, int modes) const { owner.*block = zero(modes, first_order ? modes : 0); }
};
using SidModal = SidBlock<SidContent>;
inline constexpr SidModal sid_modal_blocks[] = {
    {"mdCM", &SidContent::mdCM, {3}, {1}, true, SidModal::always},
    {"J", &SidContent::J, {6}, {1}, true, SidModal::always},
    {"Ct", &SidContent::Ct, {0, 1}, {3}, false, SidModal::with_modes},
    {"Cr", &SidContent::Cr, {0, 1}, {3}, true, SidModal::with_modes},
    {"Me", &SidContent::Me, {0, 1}, {0, 1}, false, SidModal::with_modes},
    {"Gr", &SidContent::Gr, {3}, {0, 3}, false},
    {"Ge", &SidContent::Ge, {0, 1}, {0, 3}, false},
    {"Oe", &SidContent::Oe, {0, 1}, {6}, true},
    {"ksigma", &SidContent::ksigma, {0, 1}, {1}, false},
    {"Ke", &SidContent::Ke, {0, 1}, {0, 1}, false, SidModal::with_modes},
    {"De", &SidContent::De, {0, 1}, {0, 1}, false},
};
inline constexpr SidBlock<SidFrame> sid_frame_blocks[] = {
    {"origin", &SidFrame::origin, {3}, {1}, true},
    {"phi", &SidFrame::phi, {3}, {0, 1}, false},
    {"psi", &SidFrame::psi, {3}, {0, 1}, false},
    {"AP", &SidFrame::AP, {3}, {3}, true},
};

/// The blocks of a body. Me, Ke and De are symmetrised.
SidContent sid_content(const FlexibleBody& body);

// For moments s(i, j) = int a_i b_j dm, with a = r or phi_l and b = phi_k:
inline constexpr int sid_pairs_of_Oe[3][2] = {{0, 1}, {1, 2}, {0, 2}};  ///< behind the squares
inline constexpr int sid_pairs_of_J[3][2] = {{0, 1}, {0, 2}, {1, 2}};   ///< behind the diagonal
/// Row k of Oe.
Eigen::Matrix<double, 1, 6> sid_centrifugal(const Mat3& s);
/// int a x b dm: row k of Cr.
Vec3 sid_cross(const Mat3& s);
/// Block k of Gr.
Mat3 sid_gyroscopic(const Mat3& s);
/// With phi_l and phi_k, from matrices of all modes.
Mat3 sid_moments(const std::array<std::array<MatX, 3>, 3>& S, int l, int k);

/// The text of a file.
std::string sid_text(const SidContent& content);

/// Throws InputError with every error of the text. Dimensions are checked; blocks that are missing
/// have the right size and line 0.
SidContent parse_sid_content(std::string_view text, const std::string& name);

/// The body that has these blocks. Throws InputError if they contradict each other.
SidBody sid_body(const SidContent& content, const std::string& name);

// The parts of a SID_FEM file of second order in the amplitudes: S^ij, and the displacements of
// second order (body/second_order.hpp), which are the terms of first order of phi, Ct, Cr and Oe.
// With t_ij(l, k) = S^ij(l, k) + S2i[i][j](l, k), row k of m1(l) is
//   Ct   S2[j](l, k)
//   Cr   t_ij - t_ji: the part odd in l, k is from S^ij, the even part from S2i
//   Oe   t_aa - tr t,  t_ab + t_ba: the sum of both
//   Gr   2 (tr t I - t^T), here of S^ij only: for bodies with displacements of second order
//        Floatframe writes it, so that Oe can be divided
// and phi, psi of a frame have h_j(l, k), theta_j(l, k) in row j. Files without this Gr: if Oe
// gives the modal masses it is of inertia only; else S^11, S^22, S^33 are each a third of Me and
// the rest of Oe is S2i, so that the sum, which acts on a stiffened body, is exact.

/// Sets Sij and second_order of a body that has its other invariants and nodes (in the order of the
/// frames). Me: symmetric.
void sid_second_order(const SidContent& content, const MatX& Me, FlexibleBody& body,
                      const std::function<void(int line, const std::string&)>& note);

/// The same from a body: adds to the blocks of `content`, which are those of inertia. S2i is the
/// sum of `second_order` and `turning`, which a file cannot distinguish: read again all of it acts
/// with stiffening only.
void add_sid_second_order(const FlexibleBody& body, SidContent& content);

}  // namespace floatframe
