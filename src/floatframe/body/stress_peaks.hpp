#pragma once
// The largest von Mises stress of places of a body over the instants of a motion, from the modes
// alone and with the body's own loads (body_stress.hpp), in one pass.
//
// The square of the von Mises stress is the square of the length of five numbers,
//   xx - (yy + zz) / 2,   sqrt(3)/2 (yy - zz),   sqrt(3) xy,   sqrt(3) yz,   sqrt(3) zx      (1)
// At a place the columns of modes and loads span fewer than five directions where the stress is
// that of a plane or of a bar: in an orthonormal basis of these, rows remain that number three or
// two. What is lost is below 1e-9 of the largest stress of a column in the body.
#include <vector>

#include "floatframe/body/body_stress.hpp"

namespace floatframe {

class StressPeaks {
 public:
  /// `places`: indices of BodyStress::places. `loads`: with those of the body.
  StressPeaks(const BodyStress& stress, const std::vector<int>& places, bool loads);

  /// The next instants: amplitudes, instants x nm, and if the loads are wanted their coefficients,
  /// instants x 12.
  void add(const MatX& amplitudes, const MatX& coefficients);

  struct Peak {
    double square = 0.0;        ///< of the von Mises stress [Pa^2]
    Eigen::Index instant = -1;  ///< -1: no stress so far
  };
  /// In the order of `places`.
  const std::vector<Peak>& of_modes() const noexcept { return of_modes_; }
  /// Of modes and loads; empty without loads.
  const std::vector<Peak>& of_all() const noexcept { return of_all_; }

 private:
  void add_place(const Eigen::Matrix<double, 5, Eigen::Dynamic>& columns, const VecX& largest);

  Eigen::Index modes_ = 0, load_columns_ = 0, instants_ = 0;
  MatX rows_;               ///< (nm + 12) x rows of all places: (1) in the basis of each place
  std::vector<int> first_;  ///< first row of each place, and the end
  std::vector<Peak> of_modes_, of_all_;
};

}  // namespace floatframe
