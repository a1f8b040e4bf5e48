#include "floatframe/tyres/magic_tyre.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/tyres/magic_check.hpp"
#include "floatframe/tyres/magic_radius.hpp"

namespace floatframe {

namespace {

class MagicReader {
 public:
  MagicReader(const TirFile& file, const MagicOptions& options) : file_(file), options_(options) {}

  MagicTyre read() {
    t_.version = version();
    t_.form = options_.form;
    t_.limited = options_.limits;
    t_.turning_speed = options_.turning_speed;
    t_.mirror = mirrored() ? -1.0 : 1.0;
    check_magic_file(file_, t_.version, options_, errors_);
    errors_.throw_if_any();
    sizes();
    longitudinal();
    lateral();
    combined();
    trail();
    residual();
    moments();
    load();
    relaxation();
    errors_.throw_if_any();
    return t_;
  }

 private:
  /// A coefficient; a scale factor of the model goes before that of the file.
  double c(std::string_view keyword) const {
    const auto own = options_.scales.find(std::string(keyword));
    return own == options_.scales.end() ? file_.number(keyword) : own->second;
  }
  void error(ErrorCode code, std::string_view keyword, std::string sentence) {
    errors_.add(code, file_.place(keyword), std::move(sentence));
  }

  MagicVersion version() {
    const double type = file_.number("FITTYP");
    if (type == 6.0 || type == 21.0 || type == 52.0) return MagicVersion::mf52;
    if (type == 60.0 || type == 61.0) return MagicVersion::mf61;
    if (type == 62.0) return MagicVersion::mf62;
    const bool missing = !file_.has("FITTYP");
    const std::string format = file_.word("PROPERTY_FILE_FORMAT");
    if (missing && (format == "PAC2002" || format == "MF_05")) return MagicVersion::mf52;
    if (missing)
      error(ErrorCode::missing, "FITTYP",
            "FITTYP: found none, expected 6, 21 or 52 (MF 5.2), 60, 61 (MF 6.1) or 62 (MF 6.2)");
    else
      error(ErrorCode::unsupported, "FITTYP",
            fmt::format("FITTYP: found {}, expected 6, 21 or 52 (MF 5.2), 60, 61 (MF 6.1) or 62 "
                        "(MF 6.2)",
                        number_text(file_.number("FITTYP"))));
    return MagicVersion::mf61;
  }

  /// A symmetric tyre is that of either side. Files without TYRESIDE are of the left one.
  bool mirrored() {
    const std::string side = file_.word("TYRESIDE");
    if (!side.empty() && side != "LEFT" && side != "RIGHT" && side != "SYMMETRIC")
      error(ErrorCode::wrong_value, "TYRESIDE",
            fmt::format("TYRESIDE: found '{}', expected LEFT, RIGHT or SYMMETRIC", side));
    if (options_.side == MagicSide::file || side == "SYMMETRIC") return false;
    return (options_.side == MagicSide::right) != (side == "RIGHT");
  }

  void sizes() {
    t_.R0 = c("UNLOADED_RADIUS");
    t_.Fz0 = c("FNOMIN");
    t_.nominal_load = c("LFZO") * t_.Fz0;
    t_.V0 = c("LONGVL");
    t_.width = c("WIDTH");
    t_.tread = (1.075 - 0.5 * c("ASPECT_RATIO")) * t_.width;
    range("KPU", t_.slip);
    range("ALP", t_.angle);
    range("CAM", t_.inclination);
    range("FZ", t_.load);
    if (t_.version != MagicVersion::mf52) {
      const double nominal = c(file_.has("NOMPRES") ? "NOMPRES" : "INFLPRES");
      const double pressure = magic_pressure(file_, options_);
      if (nominal > 0.0 && pressure > 0.0) dpi_ = (pressure - nominal) / nominal;  // (4.E2b)
    }
    if (t_.version == MagicVersion::mf52) {
      t_.gamma_x = c("LGAX");
      t_.gamma_y = c("LGAY");
      t_.gamma_z = c("LGAZ");
    }
  }
  void range(const std::string& quantity, MagicRange& range) const {
    if (file_.has(quantity + "MIN")) range.least = c(quantity + "MIN");
    if (file_.has(quantity + "MAX")) range.most = c(quantity + "MAX");
  }

  /// 1 + a dpi + b dpi^2.
  double pressed(double a, double b = 0.0) const { return 1.0 + (a + b * dpi_) * dpi_; }
  void pair(double (&to)[2], const char* first, const char* second, double factor = 1.0) const {
    to[0] = factor * c(first);
    to[1] = factor * c(second);
  }

  void longitudinal() {
    t_.Cx = c("PCX1") * c("LCX");
    t_.peak_x = magic_peak_argument(t_.Cx);
    pair(t_.mux, "PDX1", "PDX2", c("LMUX") * pressed(c("PPX3"), c("PPX4")));
    t_.mux_camber = c("PDX3");
    pair(t_.Kx, "PKX1", "PKX2", c("LKX") * pressed(c("PPX1"), c("PPX2")));
    t_.Kx_exponent = c("PKX3");
    triple(t_.Ex, "PEX1", "PEX2", "PEX3", c("LEX"));
    t_.Ex_side = c("PEX4");
    pair(t_.SHx, "PHX1", "PHX2", c("LHX"));
    pair(t_.SVx, "PVX1", "PVX2", c("LVX") * c("LMUX"));
  }
  void triple(double (&to)[3], const char* first, const char* second, const char* third,
              double factor) const {
    to[0] = factor * c(first);
    to[1] = factor * c(second);
    to[2] = factor * c(third);
  }

  void lateral() {
    t_.Cy = c("PCY1") * c("LCY");
    t_.peak_y = magic_peak_argument(t_.Cy);
    t_.muy_side = c("PDY1") < 0.0 ? -1.0 : 1.0;
    pair(t_.muy, "PDY1", "PDY2", t_.muy_side * c("LMUY") * pressed(c("PPY3"), c("PPY4")));
    t_.muy_camber = c("PDY3");
    // sin(p atan(-x)) = -sin(p atan(x)): with a negative PKY2 both signs change.
    const double sign = c("PKY2") < 0.0 ? -1.0 : 1.0;
    const double softer = sign * pressed(c("PPY2"));
    t_.Ky = sign * c("PKY1") * c("LKY") * pressed(c("PPY1"));
    t_.Ky_camber = c("PKY3");
    t_.Ky_sine = c("PKY4");
    t_.Ky_load = c("PKY2") * softer;
    t_.Ky_load_camber = c("PKY5") * softer;
    const double camber = c("LKYC");
    pair(t_.Kygamma, "PKY6", "PKY7", camber * pressed(c("PPY5")));
    pair(t_.Ey, "PEY1", "PEY2", c("LEY"));
    t_.Ey_camber = c("PEY5");
    t_.Ey_side = c("PEY3");
    t_.Ey_side_camber = c("PEY4");
    pair(t_.SHy, "PHY1", "PHY2", c("LHY"));
    t_.SHy_camber = c("PHY3");
    pair(t_.SVy, "PVY1", "PVY2", c("LVY") * c("LMUY"));
    pair(t_.SVygamma, "PVY3", "PVY4", camber * c("LMUY"));
  }

  void combined() {
    t_.Bxa = c("RBX1") * c("LXAL");
    t_.Bxa_camber = c("RBX3") * c("LXAL");
    t_.Bxa_slip = c("RBX2");
    t_.Cxa = c("RCX1");
    pair(t_.Exa, "REX1", "REX2");
    t_.SHxa = c("RHX1");
    t_.Byk = c("RBY1") * c("LYKA");
    t_.Byk_camber = c("RBY4") * c("LYKA");
    t_.Byk_slip = c("RBY2");
    t_.Byk_shift = c("RBY3");
    t_.Cyk = c("RCY1");
    pair(t_.Eyk, "REY1", "REY2");
    pair(t_.SHyk, "RHY1", "RHY2");
    pair(t_.SVyk, "RVY1", "RVY2", c("LVYKA"));
    t_.SVyk_camber = c("RVY3") * c("LVYKA");
    t_.SVyk_angle = c("RVY4");
    t_.SVyk_sine = c("RVY5");
    t_.SVyk_slip = c("RVY6");
  }

  void trail() {
    pair(t_.SHt, "QHZ1", "QHZ2");
    pair(t_.SHt_camber, "QHZ3", "QHZ4");
    const double stiffer = c("LKY") / c("LMUY");
    triple(t_.Bt, "QBZ1", "QBZ2", "QBZ3", stiffer);
    t_.Bt_camber = c("QBZ4");
    t_.Bt_camber_size = c("QBZ5");
    t_.Ct = c("QCZ1");
    pair(t_.Dt, "QDZ1", "QDZ2", t_.R0 / t_.nominal_load * pressed(-c("PPZ1")) * c("LTR"));
    t_.Dt_camber = c("QDZ3");
    t_.Dt_camber_square = c("QDZ4");
    triple(t_.Et, "QEZ1", "QEZ2", "QEZ3", 1.0);
    t_.Et_side = c("QEZ4");
    t_.Et_side_camber = c("QEZ5");
    const double arm = t_.R0 * c("LS");
    t_.arm = arm * c("SSZ1");
    t_.arm_force = arm * c("SSZ2") / t_.Fz0;
    pair(t_.arm_camber, "SSZ3", "SSZ4", arm);
  }

  void residual() {
    t_.Br = c("QBZ9") * c("LKY") / c("LMUY");
    t_.Br_lateral = c("QBZ10");
    const double torque = t_.R0 * c("LMUY");
    pair(t_.Dr, "QDZ6", "QDZ7", torque * c("LRES"));
    pair(t_.Dr_camber, "QDZ8", "QDZ9", torque * c("LKZC") * pressed(c("PPZ2")));
    pair(t_.Dr_camber_size, "QDZ10", "QDZ11", torque * c("LKZC"));
  }

  void moments() {
    for (int k = 0; k < 14; ++k) t_.qsx[k] = c(fmt::format("QSX{}", k + 1));
    const double all = c("LMX");
    t_.qsx[0] *= c("LVMX") * (t_.version == MagicVersion::mf52 ? 1.0 : all);
    t_.qsx[1] *= pressed(c("PPMX1"));
    for (const int k : {1, 2, 3, 9, 11, 12, 13}) t_.qsx[k] *= all;
    for (int k = 0; k < 7; ++k) t_.qsy[k] = c(fmt::format("QSY{}", k + 1));
    t_.My_scale = t_.R0 * t_.Fz0 * c("LMY") * std::pow(1.0 + dpi_, c("QSY8"));
  }

  void load() {
    const double q2 = c("Q_FZ2"), nominal = c("VERTICAL_STIFFNESS") * t_.R0 / t_.Fz0;
    double q1 = c("Q_FZ1");
    if (!file_.has("Q_FZ1")) {
      const double square = nominal * nominal - 4.0 * q2;
      if (!(square > 0.0))
        error(ErrorCode::contradiction, "Q_FZ2",
              fmt::format("Q_FZ2: found {}, expected less than {}, which the vertical stiffness "
                          "allows",
                          number_text(q2), number_text(0.25 * nominal * nominal)));
      q1 = std::sqrt(square);
    }
    const double pressure = pressed(c("PFZ1"));
    t_.Cz = t_.Fz0 / t_.R0 * std::sqrt(q1 * q1 + 4.0 * q2) * pressure;
    t_.qz[0] = q1 * t_.Fz0 * pressure;
    t_.qz[1] = q2 * t_.Fz0 * pressure;
    t_.q_re0 = c("Q_RE0");
    t_.q_v1 = c("Q_V1");
    t_.q_v2 = c("Q_V2");
    t_.q_fcx = c("Q_FCX");
    t_.q_fcy = c("Q_FCY");
    t_.q_fcy2 = c("Q_FCY2");
    for (int k = 0; k < 3; ++k) {
      t_.q_cam[k] = c(fmt::format("Q_CAM{}", k + 1));
      t_.q_fys[k] = c(fmt::format("Q_FYS{}", k + 1));
    }
    if (c("BOTTOM_STIFF") > 0.0) {
      t_.bottom_stiffness = c("BOTTOM_STIFF");
      t_.bottom_radius = c("RIM_RADIUS") + c("BOTTOM_OFFST");
    }
    t_.damping = c("VERTICAL_DAMPING");
    t_.breff = c("BREFF");
    t_.dreff = c("DREFF");
    t_.freff = c("FREFF");
    if (!file_.has("BREFF") && !file_.has("DREFF") && !file_.has("FREFF")) t_.freff = 1.0 / 3.0;
    pair(t_.q_ra, "Q_RA1", "Q_RA2");
    pair(t_.q_rb, "Q_RB1", "Q_RB2");
  }

  void relaxation() {
    const double Cx = c("LONGITUDINAL_STIFFNESS") * pressed(c("PCFX3"));
    const double Cy = c("LATERAL_STIFFNESS") * pressed(c("PCFY3"));
    t_.stiffness_x[0] = Cx;
    t_.stiffness_x[1] = Cx * c("PCFX1");
    t_.stiffness_x[2] = Cx * c("PCFX2");
    t_.stiffness_y[0] = Cy;
    t_.stiffness_y[1] = Cy * c("PCFY1");
    t_.stiffness_y[2] = Cy * c("PCFY2");
    pair(t_.sigma_x, "PTX1", "PTX2", t_.R0 / t_.Fz0 * c("LSGKP"));
    t_.sigma_x_exponent = -c("PTX3");
    t_.sigma_y = c("PTY1") * t_.R0 * c("LFZO") * c("LSGAL");
    t_.sigma_y_load = c("PTY2") * t_.Fz0;
    t_.sigma_y_camber = c("PKY3");
    const bool lengths = t_.version == MagicVersion::mf52
                             ? t_.sigma_x[0] > 0.0 && t_.sigma_y > 0.0 && t_.sigma_y_load > 0.0
                             : Cx > 0.0 && Cy > 0.0;
    if (!lengths) t_.fixed_sigma = t_.R0;
  }

  const TirFile& file_;
  const MagicOptions& options_;
  MagicTyre t_;
  ErrorList errors_;
  double dpi_ = 0.0;  ///< (p - p0)/p0
};

}  // namespace

MagicTyre magic_tyre(const TirFile& file, const MagicOptions& options) {
  return MagicReader(file, options).read();
}

}  // namespace floatframe
