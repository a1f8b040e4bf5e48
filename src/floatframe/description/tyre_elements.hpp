#pragma once
// The structs of the tyres, and of the air. Those that roll, with slip, in both directions, on a
// surface, share a RollingTyre; docs/theory.md has their equations.
#include <optional>
#include <string>

#include "floatframe/description/attachment.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

enum class TyreLaw { vertical, radial };

/// Penalty tyre on a road profile. With h = z_c - z_road(x_c) the height of the wheel centre above
/// the road below it, hdot its rate (zdot_c - s xdot_c on a road of slope s) and
/// f = max(0, k (R - h) - c hdot) while h < R: vertical: f upwards at the centre; radial:
/// f / sqrt(1 + s^2) along the road normal, at the contact point.
struct Tyre {
  AttachmentDescription centre;
  double radius = 0.0;     ///< unloaded [m]
  double stiffness = 0.0;  ///< [N/m]
  double damping = 0.0;    ///< [N s/m]
  TyreLaw law = TyreLaw::vertical;
  Vec3 axis = Vec3::UnitY();  ///< of the wheel
  std::string road;
};

/// The side of the vehicle: data of the other side are mirrored.
enum class TyreSide { left, right };
/// Of one point, or of four around it, whose mean height and plane count.
enum class TyreContact { point, patch };

/// A tyre on a wheel. Axes of its results are those of ISO-W: x forwards in the plane of the wheel,
/// z normal to the road, y to the left.
struct RollingTyre {
  AttachmentDescription centre;  ///< of the wheel
  Vec3 axis = Vec3::UnitY();     ///< of the wheel, to the left
  std::string road;
  /// The body turns with the wheel. Else it carries the axle of a wheel that rolls freely: it has
  /// no longitudinal slip, and no torque about the axis reaches the body.
  bool spinning = true;
  TyreSide side = TyreSide::left;
  TyreContact contact = TyreContact::point;
  std::optional<double> patch_length;     ///< [m]; absent: 0.2 radii
  std::optional<double> patch_width;      ///< [m]; absent: 0.3 radii
  std::optional<SignalDescription> lift;  ///< height of a plate under this tyre [m]
  double damping = 0.0;                   ///< of the deflection [N s/m]
  bool relaxation = true;                 ///< slips follow the motion along a length
  std::optional<double> rest_damping;     ///< of the slip at rest [N s/m]; absent: 3 ms x stiffness
  double damping_speed = 2.5;             ///< at which it has faded out [m/s]
};

/// Vertical spring, slip stiffnesses, trail and a limit of friction.
struct LinearTyre : RollingTyre {
  double radius = 0.0;                 ///< unloaded [m]
  double stiffness = 0.0;              ///< vertical [N/m]
  double slip_stiffness = 0.0;         ///< dFx/dkappa [N]
  double cornering_stiffness = 0.0;    ///< -dFy/dtan(alpha) [N]
  double camber_stiffness = 0.0;       ///< -dFy/dgamma [N/rad]
  std::optional<double> nominal_load;  ///< these three are of, and proportional to [N]; absent:
                                       ///< they do not depend on the load
  double trail = 0.0;                  ///< pneumatic [m]
  double friction = 1.0;               ///< limit of the horizontal force over the load
  double relaxation_x = 0.0, relaxation_y = 0.0;  ///< lengths sigma [m]
  double rolling_resistance = 0.0;                ///< torque over load and radius
};

/// How the Magic Formula takes slip angle and camber: in rad, as the manual of MF-Tyre 6.x, or as
/// tan(alpha) and sin(gamma), as Pacejka's book.
enum class SlipForm { manual, book };

/// Magic Formula 5.2, 6.1 or 6.2 with the coefficients of a tyre property file.
struct MagicFormulaTyre : RollingTyre {
  std::string file;  ///< path of a .tir; of a built element: the hash of its content
  SlipForm form = SlipForm::manual;
  std::optional<double> pressure;  ///< [Pa]; absent: that of the file
  bool limits = false;             ///< slips, camber and load within the ranges of the file
  double friction = 1.0;           ///< factor of the scale factors LMUX and LMUY
  double stiffness_factor = 1.0;   ///< factor of LKX and LKY
  std::string text = {};           ///< content of the file; empty: it is read
};

/// TMeasy: values at the nominal load and at twice, in rows.
struct TmeasyTyre : RollingTyre {
  double radius = 0.0;             ///< unloaded [m]
  double nominal_load = 0.0;       ///< [N]
  std::optional<double> max_load;  ///< above which tables are held [N]; absent: 3.5 x nominal
  MatX stiffness;                  ///< 1 x 2, vertical, at both loads [N/m]
  MatX longitudinal, lateral;  ///< 2 x 5: slope [N], maximum [N], its slip, sliding [N], its slip
  MatX trail;                  ///< 2 x 3: over the contact length, slips of its zero and its end
  double longitudinal_stiffness = 0.0, lateral_stiffness = 0.0;  ///< of the carcass [N/m]
  double rolling_radius = 0.67;     ///< share of the unloaded radius in the effective one
  double friction = 1.0;            ///< of the road over that of the tables
  bool normalised = true;           ///< slips
  double rolling_resistance = 0.0;  ///< torque over load and radius
};

/// Side force and aligning moment of slip angle and camber, no longitudinal force.
/// Its load is that of the height of the wheel centre.
struct CalspanTyre : RollingTyre {
  double radius = 0.0;                 ///< unloaded [m]
  double stiffness = 0.0;              ///< vertical [N/m]
  MatX cornering;                      ///< 1 x 3: A0 [N/rad], A1 [1/rad], A2 [N]
  MatX camber;                         ///< 1 x 2: A3 [1/rad], A4 [N]
  MatX friction;                       ///< 1 x 3: B1 [1/N], B3, B4 [1/N^2]
  MatX aligning;                       ///< 1 x 2: AF1, AF2 [m/N]; 0 x 0: none
  double load_limit = 1.0;             ///< Omega_T: stiffnesses are held above this x A2
  double skid_number = 1.0;            ///< SN
  std::optional<double> relaxation_y;  ///< length [m]; absent: slips follow at once
};

/// Drag, side force and lift of the air on a body, at one point. With the air speed u = wind - v of
/// the point, along e1 = forwards, e2, e3 = up, which turn with the body: F = density/2 area |u|
/// (drag u1 e1 + side u2 e2 + lift |u| e3).
struct AerodynamicLoad {
  AttachmentDescription at;
  Vec3 axis = Vec3::UnitZ(), axis_2 = Vec3::UnitX();  ///< up, forwards
  double area = 0.0;                                  ///< [m^2]
  double drag = 0.0, side = 0.0;                      ///< coefficients [-]
  double lift = 0.0;                                  ///< the same; negative: downforce
  double density = 1.2;                               ///< [kg/m^3]
  std::optional<SignalDescription> wind;              ///< speed of the air [m/s]; absent: 0
  Vec3 wind_direction = Vec3::UnitX();                ///< where it blows to, in the world
};

}  // namespace floatframe
