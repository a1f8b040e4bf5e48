#pragma once
// The largest von Mises stress at each place of a body (body_stress.hpp) over a run, its instant
// and the stress tensor at that instant; for beams the smallest and the largest section forces.
// Instants are collected and evaluated together:
//   stress = modes Y + loads C,   a column of Y and C for each instant,
// are two products of matrices, many places times many instants.
#include <vector>

#include "floatframe/body/body_stress.hpp"

namespace floatframe {

struct StressEnvelope {
  // Of each place.
  VecX von_mises;  ///< [Pa]
  VecX time;       ///< [s] first instant of the largest value
  Mat6X stress;    ///< xx yy zz xy yz zx at that instant, body axes [Pa]

  // Of each section of beams: N Vy Vz [N], T My Mz [Nm].
  Mat6X least, least_time, largest, largest_time;
};

class StressEnvelopeOf {
 public:
  /// `stress` must outlive this. `modes`: number of modes of the body.
  StressEnvelopeOf(const BodyStress& stress, int modes);
  /// The next instant: amplitudes (nm) and load coefficients (12 + nm) of the body.
  void add(double time, const VecX& y, const VecX& c);
  /// Result over all instants so far.
  const StressEnvelope& result();

 private:
  void flush();
  void flush_places(Eigen::Index instants);
  void flush_sections(Eigen::Index instants);

  const BodyStress& stress_;
  MatX Y_, C_;  ///< amplitudes and load coefficients of the collected instants, one per column
  std::vector<double> times_;
  MatX values_;
  VecX squares_;  ///< of the von Mises stresses so far
  StressEnvelope envelope_;
};

}  // namespace floatframe
