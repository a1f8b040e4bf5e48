#pragma once
// The coefficients of a Magic Formula tyre as steps read them: scale factors and the inflation
// pressure are already multiplied in. Made once, at load time, from a tyre file.
// Names are those of the formulas (magic_formula.hpp); a pair {a0, a1} is a0 + a1 dfz, dfz =
// (Fz - Fz0')/Fz0', Fz0' = LFZO FNOMIN. Units: N, m, rad, m/s.
#include <map>
#include <string>
#include <vector>

#include "floatframe/tyres/tir_file.hpp"

namespace floatframe {

/// Which of two readings of the equations holds: the manual of MF-Tyre 6.x takes the slip angle and
/// the camber in rad, the book (4.E3, 4.E4) takes tan(alpha) and sin(gamma). They differ by 0.6 %
/// of Fy at 25 deg.
enum class MagicForm : unsigned char { manual, book };
enum class MagicVersion : unsigned char { mf52, mf61, mf62 };

enum class MagicSide : unsigned char { file, left, right };

/// What a model chooses beside the file.
struct MagicOptions {
  MagicForm form = MagicForm::manual;
  /// [Pa]; zero: INFLPRES of the file.
  double pressure = 0.0;
  /// Slip, camber and load within the ranges of the file; forces beyond the range of the load grow
  /// in proportion to it.
  bool limits = false;
  /// Where the wheel is: a tyre that was measured on the other side (TYRESIDE) is mirrored.
  MagicSide side = MagicSide::file;
  /// Below this speed forward and backward rolling blend into each other [m/s].
  double turning_speed = 1.0;
  /// Scale factors instead of those of the file, as {"LMUY", 0.8}.
  std::map<std::string, double> scales = {};
};

struct MagicRange {
  double least = -1e300;
  double most = 1e300;
};

struct MagicTyre {
  MagicVersion version = MagicVersion::mf61;
  MagicForm form = MagicForm::manual;
  bool limited = false;
  double mirror = 1.0;  ///< -1 for a mirrored tyre
  double turning_speed = 1.0;

  double R0 = 0.0;            ///< UNLOADED_RADIUS
  double Fz0 = 0.0;           ///< FNOMIN
  double nominal_load = 0.0;  ///< Fz0' = LFZO FNOMIN
  double V0 = 0.0;            ///< LONGVL
  MagicRange slip, angle, inclination, load;

  // Longitudinal force of pure slip, (4.E9) - (4.E18). SVx and Kx are divided by Fz.
  double Cx = 0.0;
  double mux[2] = {}, mux_camber = 0.0;
  double Kx[2] = {}, Kx_exponent = 0.0;
  double Ex[3] = {}, Ex_side = 0.0;
  double SHx[2] = {}, SVx[2] = {};
  // Its weight with a slip angle, (4.E50) - (4.E57).
  double Bxa = 0.0, Bxa_camber = 0.0, Bxa_slip = 0.0, Cxa = 0.0, Exa[2] = {}, SHxa = 0.0;

  double peak_x = 1.0, peak_y = 1.0;  ///< tan(pi/(2 C)) of both forces (magic_radius.hpp)

  // Lateral force of pure slip, (4.E19) - (4.E30).
  double Cy = 0.0;
  double muy[2] = {}, muy_camber = 0.0, muy_side = 1.0;  ///< PDY1 may be negative: then so is side
  /// Kya/Fz = Ky/N (1 - Ky_camber |gamma|) sin(Ky_sine atan(x))/x, x = Fz/(Fz0' N), N = Ky_load +
  /// Ky_load_camber gamma^2.
  double Ky = 0.0, Ky_camber = 0.0, Ky_sine = 2.0, Ky_load = 0.0, Ky_load_camber = 0.0;
  double Kygamma[2] = {};  ///< camber stiffness divided by Fz; 5.2: zero
  double Ey[2] = {}, Ey_camber = 0.0, Ey_side = 0.0, Ey_side_camber = 0.0;
  double SHy[2] = {}, SHy_camber = 0.0;
  double SVy[2] = {}, SVygamma[2] = {};
  // Its weight with longitudinal slip and the force by longitudinal slip, (4.E58) - (4.E67).
  double Byk = 0.0, Byk_camber = 0.0, Byk_slip = 0.0, Byk_shift = 0.0, Cyk = 0.0, Eyk[2] = {};
  double SHyk[2] = {};
  double SVyk[2] = {}, SVyk_camber = 0.0, SVyk_angle = 0.0, SVyk_sine = 0.0, SVyk_slip = 0.0;

  // Trail and residual torque, (4.E31) - (4.E49), and the arm of Fx, (4.E76). Dt is divided by Fz,
  // Dr by Fz.
  double SHt[2] = {}, SHt_camber[2] = {};
  double Bt[3] = {}, Bt_camber = 0.0, Bt_camber_size = 0.0, Ct = 0.0;
  double Dt[2] = {}, Dt_camber = 0.0, Dt_camber_square = 0.0;
  double Et[3] = {}, Et_side = 0.0, Et_side_camber = 0.0;
  double Br = 0.0, Br_lateral = 0.0;
  double Dr[2] = {}, Dr_camber[2] = {}, Dr_camber_size[2] = {};
  double arm = 0.0, arm_force = 0.0, arm_camber[2] = {};

  // Overturning moment, (4.E69): QSX1 ... QSX14 in its order, zero-based; and rolling resistance,
  // (4.E70) in the form of the manual: QSY1 ... QSY7.
  double qsx[14] = {};
  double qsy[7] = {}, My_scale = 0.0;
  double gamma_x = 1.0, gamma_y = 1.0, gamma_z = 1.0;  ///< LGAX, LGAY, LGAZ of 5.2

  // Radii, patch, stiffnesses and relaxation (magic_radius.hpp).
  double Cz = 0.0;  ///< at the nominal load, with pressure [N/m]
  double q_re0 = 1.0, q_v1 = 0.0, q_v2 = 0.0, q_fcx = 0.0, q_fcy = 0.0, q_fcy2 = 0.0;
  double qz[2] = {};  ///< Fz = (qz0 rho/R0 + qz1 (rho/R0)^2) ... [N]
  double q_cam[3] = {}, q_fys[3] = {}, tread = 0.0;
  double bottom_stiffness = 0.0, bottom_radius = -1e300;
  double breff = 0.0, dreff = 0.0, freff = 0.0;
  double q_ra[2] = {}, q_rb[2] = {}, width = 0.0;
  double damping = 0.0;  ///< VERTICAL_DAMPING [N s/m]
  double stiffness_x[3] = {}, stiffness_y[3] = {};
  double sigma_x[2] = {}, sigma_x_exponent = 0.0;  ///< 5.2: sigma_kappa/Fz [m/N]
  double sigma_y = 0.0, sigma_y_load = 0.0, sigma_y_camber = 0.0;
  double fixed_sigma = 0.0;  ///< where the file has neither [m]
};

/// The tyre of a file. Coefficients that it lacks are zero, scale factors 1, PKY4 2, QSY7 1, LONGVL
/// 16.7 m/s; relaxation lengths R0 without structural stiffnesses or PTX and PTY; Re is Rl + 2/3 of
/// the deflection without BREFF, DREFF and FREFF. Throws InputError with the place in the file
/// where a coefficient that the formulas divide by is missing, zero or of the wrong sign.
MagicTyre magic_tyre(const TirFile& file, const MagicOptions& options = {});

}  // namespace floatframe
