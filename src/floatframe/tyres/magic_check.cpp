#include "floatframe/tyres/magic_check.hpp"

#include <fmt/format.h>

#include <cmath>

#include "floatframe/core/number_rule.hpp"
#include "floatframe/tyres/magic_radius.hpp"

namespace floatframe {

namespace {

/// 1 + a dpi + b dpi^2 multiplies a stiffness or a friction.
struct PressureFactor {
  const char *linear, *square, *of;
};
constexpr PressureFactor pressure_factors[] = {{"PPX1", "PPX2", "longitudinal slip stiffness"},
                                               {"PPX3", "PPX4", "longitudinal friction"},
                                               {"PPY1", "", "cornering stiffness"},
                                               {"PPY2", "", "load of the cornering stiffness"},
                                               {"PPY3", "PPY4", "lateral friction"},
                                               {"PFZ1", "", "vertical stiffness"},
                                               {"PCFX3", "", "longitudinal stiffness"},
                                               {"PCFY3", "", "lateral stiffness"}};
/// Tyres are loaded by up to twice FNOMIN.
constexpr double least_top_load = 2.0;

class MagicCheck {
 public:
  MagicCheck(const TirFile& file, MagicVersion version, const MagicOptions& options,
             ErrorList& errors)
      : file_(file), version_(version), options_(options), errors_(errors) {}

  void all() {
    sizes();
    scales();
    coefficients();
    ranges();
    pressure();
    vertical();
  }

 private:
  void error(ErrorCode code, std::string_view keyword, std::string sentence) {
    errors_.add(code, file_.place(keyword), std::move(sentence));
  }
  /// A number that the file gives, or a scale factor.
  void need(std::string_view keyword, const NumberRule& rule) {
    if (!file_.has(keyword)) return;
    if (const auto wrong = rule.complaint(file_.number(keyword)))
      error(ErrorCode::out_of_range, keyword, fmt::format("{}: {}", keyword, *wrong));
  }
  void need_there(std::string_view keyword, const NumberRule& rule) {
    if (!file_.has(keyword))
      error(ErrorCode::missing, keyword,
            fmt::format("{}: found none, expected {}", keyword, rule.expectation()));
    need(keyword, rule);
  }
  void need_other_than_zero(std::string_view keyword) {
    if (!file_.has(keyword))
      error(ErrorCode::missing, keyword,
            fmt::format("{}: found none, expected a number other than 0", keyword));
    else if (file_.number(keyword) == 0.0)
      error(ErrorCode::out_of_range, keyword,
            fmt::format("{}: found 0, expected a number other than 0", keyword));
  }

  void sizes() {
    need_there("UNLOADED_RADIUS", positive_number("m"));
    need_there("FNOMIN", positive_number("N"));
    need_there("VERTICAL_STIFFNESS", positive_number("N/m"));
    need("LONGVL", positive_number("m/s"));
    need("NOMPRES", positive_number("Pa"));
    if (version_ != MagicVersion::mf52) need("INFLPRES", positive_number("Pa"));
    need("Q_RE0", positive_number(""));
    for (const char* keyword : {"WIDTH", "RIM_RADIUS"}) need(keyword, non_negative_number("m"));
    for (const char* keyword : {"LONGITUDINAL_STIFFNESS", "LATERAL_STIFFNESS", "BOTTOM_STIFF"})
      need(keyword, non_negative_number("N/m"));
    need("VERTICAL_DAMPING", non_negative_number("N s/m"));
  }

  /// The law divides by those of friction and stiffness; others only must not turn a sign.
  void scales() {
    for (const char* keyword : {"LFZO", "LCX", "LMUX", "LKX", "LCY", "LMUY", "LKY"})
      need(keyword, positive_number(""));
    for (const char* keyword : {"LTR", "LRES", "LMX", "LMY", "LXAL", "LYKA", "LKYC", "LKZC"})
      need(keyword, non_negative_number(""));
    for (const char* keyword : {"LSGKP", "LSGAL"})
      need(keyword, version_ == MagicVersion::mf52 ? positive_number("") : non_negative_number(""));
  }

  void coefficients() {
    for (const char* keyword : {"PCX1", "PDX1", "PKX1", "PCY1"})
      need_there(keyword, positive_number(""));
    for (const char* keyword : {"PDY1", "PKY1", "PKY2"}) need_other_than_zero(keyword);
    if (file_.number("PKY1") * file_.number("PKY2") > 0.0)
      error(ErrorCode::out_of_range, "PKY1",
            fmt::format("PKY1: found {} with PKY2 {}, expected opposite signs: a positive slip "
                        "angle gives a negative force in the axes ISO-W",
                        number_text(file_.number("PKY1")), number_text(file_.number("PKY2"))));
    need("PKY4", positive_number(""));
    for (const char* keyword : {"BREFF", "DREFF", "Q_FZ1"}) need(keyword, non_negative_number(""));
    if (version_ == MagicVersion::mf52)
      for (const char* keyword : {"PTX1", "PTY1", "PTY2"}) need(keyword, non_negative_number(""));
  }

  void ranges() {
    NumberRule below{"a number <= 0: zero is within the range", ""}, above = below;
    below.high = above.low = 0.0;
    above.what = "a number >= 0: zero is within the range";
    for (const char* keyword : {"KPUMIN", "ALPMIN", "CAMMIN"}) need(keyword, below);
    for (const char* keyword : {"KPUMAX", "ALPMAX", "CAMMAX"}) need(keyword, above);
    need("FZMAX", positive_number("N"));
  }

  void pressure() {
    const double nominal = file_.number(file_.has("NOMPRES") ? "NOMPRES" : "INFLPRES");
    const double p = magic_pressure(file_, options_);
    if (version_ == MagicVersion::mf52 || !(nominal > 0.0 && p > 0.0)) return;
    const double dpi = (p - nominal) / nominal;
    for (const PressureFactor& f : pressure_factors) {
      if (1.0 + (file_.number(f.linear) + file_.number(f.square) * dpi) * dpi > 0.0) continue;
      const bool own = options_.pressure > 0.0;
      return error(ErrorCode::out_of_range, own ? f.linear : "INFLPRES",
                   fmt::format("{}: found {:g} Pa, where {} leaves no {}, expected a pressure "
                               "nearer to NOMPRES, {:g} Pa",
                               own ? "pressure" : "INFLPRES", p, f.linear, f.of, nominal));
    }
  }

  /// (q1 x + q2 x^2) Fz0 with a negative q2 is largest at q1^2/(-4 q2) Fz0 and falls beyond.
  void vertical() {
    const double q2 = file_.number("Q_FZ2");
    if (!(q2 < 0.0)) return;
    const double nominal = file_.number("VERTICAL_STIFFNESS") * file_.number("UNLOADED_RADIUS") /
                           file_.number("FNOMIN");
    const double q1 = file_.number("Q_FZ1");
    const double square = file_.has("Q_FZ1") ? q1 * q1 : nominal * nominal - 4.0 * q2;
    const double top = square / (-4.0 * q2);
    if (top < least_top_load)
      error(ErrorCode::out_of_range, "Q_FZ2",
            fmt::format("Q_FZ2: found {}, by which the load never exceeds {:.3g} times FNOMIN, "
                        "expected a number that lets it rise to {:g} times FNOMIN",
                        number_text(q2), top, least_top_load));
  }

  const TirFile& file_;
  MagicVersion version_;
  const MagicOptions& options_;
  ErrorList& errors_;
};

}  // namespace

double magic_pressure(const TirFile& file, const MagicOptions& options) {
  if (options.pressure > 0.0) return options.pressure;
  return file.number(file.has("INFLPRES") ? "INFLPRES" : "NOMPRES");
}

void check_magic_file(const TirFile& file, MagicVersion version, const MagicOptions& options,
                      ErrorList& errors) {
  MagicCheck(file, version, options, errors).all();
}

std::vector<std::string> magic_notes(const TirFile& file, const MagicTyre& tyre,
                                     const MagicOptions& options) {
  std::vector<std::string> notes;
  const auto outside = [&](const char* keyword, double x, const char* quantity, const char* unit) {
    for (const char* end : {"MIN", "MAX"}) {
      const std::string limit = std::string(quantity) + end;
      if (!file.has(limit)) continue;
      const double bound = file.number(limit);
      if (limit.ends_with("MIN") ? x >= bound : x <= bound) continue;
      const int line = file.place(file.has(keyword) ? keyword : limit).line;
      notes.push_back(fmt::format("line {}: {} {:g} {} is beyond {}, {:g} {}", line, keyword, x,
                                  unit, limit, bound, unit));
    }
  };
  const double pressure = magic_pressure(file, options);
  if (tyre.version != MagicVersion::mf52 && pressure > 0.0)
    outside(options.pressure > 0.0 ? "pressure"
            : file.has("INFLPRES") ? "INFLPRES"
                                   : "NOMPRES",
            pressure, "PRES", "Pa");
  outside("FNOMIN", tyre.Fz0, "FZ", "N");
  // Deflection at FNOMIN, by (qz0 + qz1 x) x = Fz0.
  const double root = std::sqrt(tyre.qz[0] * tyre.qz[0] + 4.0 * tyre.qz[1] * tyre.Fz0);
  const double free = free_radius(tyre, 0.0);
  const double loaded = free - tyre.R0 * 2.0 * tyre.Fz0 / (tyre.qz[0] + root);
  const double rolling = magic_effective_radius(tyre, tyre.Fz0, 0.0);
  if (!(loaded > 0.0))
    notes.push_back(
        fmt::format("line {}: the tyre is flat at FNOMIN", file.place("VERTICAL_STIFFNESS").line));
  else if (rolling < loaded || rolling > free)
    notes.push_back(
        fmt::format("BREFF, DREFF and FREFF give an effective radius of {:.4g} m at FNOMIN, which "
                    "is not between the loaded one, {:.4g} m, and the free one, {:.4g} m",
                    rolling, loaded, free));
  if (!(tyre.fixed_sigma > 0.0)) return notes;
  notes.push_back(fmt::format(
      "{} are not given or 0: UNLOADED_RADIUS is taken as relaxation length",
      tyre.version == MagicVersion::mf52 ? "PTX1, PTY1 and PTY2"
                                         : "LONGITUDINAL_STIFFNESS and LATERAL_STIFFNESS"));
  return notes;
}

}  // namespace floatframe
