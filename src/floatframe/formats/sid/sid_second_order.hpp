#pragma once
// Of a SID_FEM file what is of second order in the amplitudes: S^ij, and the displacements of
// second order (body/second_order.hpp), which are the terms of first order of phi, Ct, Cr and Oe.
// With t_ij(l, k) = S^ij(l, k) + S2i[i][j](l, k), row k of m1(l) is
//   Ct   S2[j](l, k)
//   Cr   t_ij - t_ji: odd in l, k what S^ij has of it, even what S2i has
//   Oe   t_aa - tr t,  t_ab + t_ba: the sum of both
//   Gr   2 (tr t I - t^T), here of S^ij alone: of bodies with displacements of second order
//        Floatframe writes it, so that Oe can be divided
// and phi, psi of a frame have h_j(l, k), theta_j(l, k) in row j. Files without this Gr: if Oe
// gives the modal masses it is of inertia alone; else S^11, S^22, S^33 are each a third of Me and
// the rest of Oe is S2i, so that the sum, which is what a stiffened body feels, is exact.
#include <functional>
#include <string>

#include "floatframe/formats/sid/sid_content.hpp"

namespace floatframe {

/// Sets Sij and second_order of a body that has its other invariants and nodes (in the order of the
/// frames). Me: symmetric.
void sid_second_order(const SidContent& content, const MatX& Me, FlexibleBody& body,
                      const std::function<void(int line, const std::string&)>& note);

/// The same from a body: adds to the blocks of `content`, which are those of inertia. S2i is the
/// sum of `second_order` and `turning`, which a file cannot tell apart: read again all of it counts
/// with stiffening only.
void add_sid_second_order(const FlexibleBody& body, SidContent& content);

}  // namespace floatframe
