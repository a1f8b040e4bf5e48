#pragma once
// What the signals between elements add to the tangent of a step. With the inner variables of the
// elements that they connect - states z, which follow with the weight w, and signals u - an element
// has wrenches W, zdot and results h, and
//   w dz = zdot_p dp + zdot_v dv + zdot_z dz + zdot_u du,  du = factor (h_p dp + ... + h_u du)  (1)
// for the motion dp and the rates dv of its markers. (1) is solved for du = g_p dp + g_v dv of the
// signals to elements that exert forces. The rows of the elements contain what follows without du;
// the rest is, for each such signal, of rank one:
//   T += B V^T,  B = J^T dW/du with z following u alone,  V = J^T (s g_p + c g_v)              (2)
// Step time: no heap, noexcept.
#include <Eigen/LU>
#include <vector>

#include "floatframe/model/element_evaluation.hpp"

namespace floatframe {

class Formulation;

class SignalTangent {
 public:
  /// Allocates.
  explicit SignalTangent(const Model& model);
  /// The signals to elements that exert forces.
  int rank() const noexcept { return static_cast<int>(acting_.size()); }
  /// (2) at the last evaluation of forces, with nv x rank matrices; `damping` is c.
  void find(Formulation& f, double damping, double s, MatX& B, MatX& V) noexcept;

 private:
  struct Member {
    std::size_t element;
    int first, states;         ///< unknowns of (1)
    std::vector<int> columns;  ///< unknowns of its inner variables
    std::vector<int> results;  ///< links from it
    TangentFinder finder;
    const EffortTangent* tangent = nullptr;
    MatX own;     ///< d(inner)/du of its links, with its states following: inner x links
    MatX slopes;  ///< w - zdot_z
    Eigen::PartialPivLU<MatX> lu;
    std::vector<Wrench> wrenches;
  };
  struct Acting {
    int link;
    std::size_t member;
    int port;  ///< among the links of the member
  };
  void find_system(const Formulation& f) noexcept;
  void follow(Member& m, double weight) noexcept;
  void add_gains(Formulation& f, double damping, double s, const VecX& a, VecX& out) noexcept;

  const Model& model_;
  std::vector<Member> members_;
  std::vector<Acting> acting_;
  int first_link_ = 0;  ///< unknown of link 0
  MatX transposed_;     ///< of (1)
  Eigen::PartialPivLU<MatX> lu_;
  VecX unit_, gains_, forces_;
};

}  // namespace floatframe
