// Magic Formula 5.2, 6.1 and 6.2 with the coefficients of a tyre property file, in the contact and
// with the states of rolling_slips.hpp; the formulas are those of tyres/magic_formula.hpp and
// tyres/magic_radius.hpp.
//   load        magic_load of the loaded radius R0 - d, camber and spin, without Fx and Fy: these
//               take the part (q_fcx F_x/F_z0)^2 + (q_fcy F_y/F_z0)^2 of the load
//   lengths     K/C or by PTX and PTY, at least R0/20; stiffness at rest K/sigma;
//               L = sigma slip of the peak, times the friction of the road
//   energy      that of a tyre at rest
// A tyre of the side that its file does not say is mirrored by the generic law.
#include "floatframe/core/content_hash.hpp"
#include "floatframe/model/rolling_tyre_kind.hpp"
#include "floatframe/tyres/magic_check.hpp"
#include "floatframe/tyres/magic_radius.hpp"

namespace floatframe {

namespace {

/// Of one file; the example of the tests scales it.
struct MagicTyreData {
  MagicTyre tyre;
  bool mirrored = false;
  std::vector<std::string> notes;  ///< what was ignored or assumed
};

struct MagicTyreLaw {
  using Keys = MagicFormulaTyre;
  using Data = MagicTyreData;
  static constexpr bool falls = true, slip_of_centre = false;

  static double radius(const Keys&, const Data& data) noexcept { return data.tyre.R0; }
  static bool mirrored(const Keys&, const Data& data) noexcept { return data.mirrored; }
  template <class S>
  static S load(const Keys&, const Data& data, const S& deflection, const S& camber,
                const S& spin) noexcept {
    const S zero = 0.0;
    return magic_load(data.tyre, S(data.tyre.R0 - deflection), camber, spin, zero, zero);
  }
  template <class S>
  static S effective_radius(const Keys&, const Data& data, const S& load, const S&,
                            const S& spin) noexcept {
    return magic_effective_radius(data.tyre, load, spin);
  }
  template <class S>
  static TyreLengths<S> lengths(const Keys&, const Data& data, const S& load, const S& camber,
                                double friction) noexcept {
    const MagicStanding<S> at(data.tyre, load, camber);
    const MagicLengths<S> m = magic_lengths(data.tyre, load, at);
    const double least = 0.05 * data.tyre.R0;
    TyreLengths<S> l;
    l.sigma_x = at_least(m.sigma_x, least);
    l.sigma_y = at_least(m.sigma_y, least);
    l.stiffness_x = m.Cx * m.sigma_x / l.sigma_x;
    l.stiffness_y = m.Cy * m.sigma_y / l.sigma_y;
    put_limits(magic_peaks(data.tyre, at, true), friction, l);
    return l;
  }
  template <class S>
  static void limits(const Keys&, const Data& data, const S& load, const S& camber, double friction,
                     TyreLengths<S>& l) noexcept {
    const MagicStanding<S> at(data.tyre, load, camber);
    put_limits(magic_peaks(data.tyre, at, false), friction, l);
  }
  template <class S>
  static void put_limits(const MagicPeaks<S>& slip, double friction, TyreLengths<S>& l) noexcept {
    l.limit_x = friction * slip.x * l.sigma_x;
    l.limit_y = friction * slip.y * l.sigma_y;
  }
  template <class S, class B>
  static TyreForces<S, B> forces(const Keys&, const Data& data, const TyreInput<S, B>& x) noexcept {
    using std::sqrt;
    // The generic law turns and fades the rolling moment of a wheel that rolls forwards.
    const double forwards = 1.0 + data.tyre.turning_speed;
    const MagicForces<S, B> f = magic_forces(
        data.tyre, MagicInput<S, B>{x.load, x.kappa, x.tan_alpha, x.camber, x.v_cx,
                                    value_of(x.v_cx) < 0.0 ? -forwards : forwards, x.friction});
    TyreForces<S, B> out;
    out.F_x = f.Fx;
    out.F_y = f.Fy;
    out.M_x = f.Mx;
    out.M_y = value_of(x.v_cx) < 0.0 ? B(-f.My) : f.My;
    out.M_z = f.Mz;
    const B a = in_scalar<B>(f.Fx) / (f.mux * x.load), b = in_scalar<B>(f.Fy) / (f.muy * x.load);
    out.friction_use = sqrt(B(a * a + b * b));
    return out;
  }
  template <class S>
  static S energy(const Keys&, const Data& data, const S& deflection) noexcept {
    const MagicTyre& t = data.tyre;
    const S rho = deflection + t.R0 * (t.q_re0 - 1.0), x = at_least(S(rho / t.R0), 0.0);
    return t.R0 * x * x * (0.5 * t.qz[0] + t.qz[1] / 3.0 * x);
  }
};

template <class S>
void magic_formula_tyre_law(const PortsOf<S>& in, EffortsOf<S>& out) noexcept {
  rolling_tyre_law<MagicTyreLaw>(in, out);
}

}  // namespace

FLOATFRAME_LAW(magic_formula_tyre)

namespace {

constexpr const char* magic_forms[] = {"manual", "book"};

constexpr FileContent magic_tyre_file = {described_by<&MagicFormulaTyre::text>, tir_text};

constexpr ElementKey magic_tyre_own[] = {
    {.name = "file",
     .kind = KeyKind::file,
     .about = "tyre property file (`.tir`) of MF 5.2, 6.1 or 6.2",
     .required = true,
     .member = described_by<&MagicFormulaTyre::file>,
     .content = &magic_tyre_file},
    {.name = "form",
     .kind = KeyKind::word,
     .about = "slip angle and camber in rad, or their tangent and sine",
     .words = magic_forms,
     .member = described_by<&MagicFormulaTyre::form>},
    rolling_number("pressure", "of inflation; without it that of the file", positive_number("Pa"),
                   described_by<&MagicFormulaTyre::pressure>),
    {.name = "limits",
     .kind = KeyKind::flag,
     .about = "slips, camber and load stay within the ranges of the file",
     .fallback = 0.0,
     .member = described_by<&MagicFormulaTyre::limits>},
    rolling_number("friction", "factor of LMUX and LMUY", positive_number(""),
                   described_by<&MagicFormulaTyre::friction>, 1.0),
    rolling_number("stiffness_factor", "factor of LKX and LKY", positive_number(""),
                   described_by<&MagicFormulaTyre::stiffness_factor>, 1.0)};
constexpr auto magic_tyre_keys = rolling_keys<MagicFormulaTyre>(magic_tyre_own);

MagicTyreData magic_tyre_data(const TirFile& file, const MagicFormulaTyre& keys) {
  MagicOptions options;
  options.form = keys.form == SlipForm::book ? MagicForm::book : MagicForm::manual;
  options.pressure = keys.pressure.value_or(0.0);
  options.limits = keys.limits;
  options.side = keys.side == TyreSide::left ? MagicSide::left : MagicSide::right;
  for (const char* scale : {"LMUX", "LMUY"})
    options.scales[scale] = keys.friction * file.number(scale);
  for (const char* scale : {"LKX", "LKY"})
    options.scales[scale] = keys.stiffness_factor * file.number(scale);
  MagicTyreData data;
  data.tyre = magic_tyre(file, options);
  data.mirrored = data.tyre.mirror < 0.0;
  data.tyre.mirror = 1.0;
  for (const std::string& note : file.notes) data.notes.push_back(keys.file + ": " + note);
  for (const std::string& note : magic_notes(file, data.tyre, options))
    data.notes.push_back(keys.file + ": " + note);
  return data;
}

bool magic_tyre_build(ElementBuild& build) {
  MagicFormulaTyre& keys = build.keys<MagicFormulaTyre>();
  try {
    const std::string text = keys.text.empty() ? tir_text(keys.file) : keys.text;
    const MagicTyreData data = magic_tyre_data(parse_tir(text, keys.file), keys);
    if (keys.damping == 0.0) keys.damping = data.tyre.damping;
    keys.file = content_hash(text);
    keys.text.clear();
    build.element.data = std::make_shared<const MagicTyreData>(data);
  } catch (const InputError& wrong) {
    for (const ErrorEntry& entry : wrong.errors()) build.error(entry.code, entry.text());
    return false;
  }
  return build_rolling_tyre(build, keys);
}

/// A small tyre with every part of the formulas.
constexpr const char* magic_example_text = R"([MODEL]
FITTYP = 61
[UNITS]
LENGTH = 'm'
[DIMENSION]
UNLOADED_RADIUS = 0.4
WIDTH = 0.2
[VERTICAL]
FNOMIN = 100
VERTICAL_STIFFNESS = 1200
Q_RE0 = 1.0
Q_V1 = 0.0008
Q_V2 = 0.04
Q_FZ2 = 1.5
BREFF = 8
DREFF = 0.25
FREFF = 0.07
[STRUCTURAL]
LONGITUDINAL_STIFFNESS = 4000
LATERAL_STIFFNESS = 3000
[COEFFICIENTS]
PCX1 = 1.58
PDX1 = 1.04
PDX2 = -0.08
PEX1 = 0.11
PKX1 = 21.7
PKX3 = -0.4
PHX1 = 0.0002
PVX1 = 0.0001
PCY1 = 1.34
PDY1 = 0.88
PDY2 = -0.06
PEY1 = -0.8
PEY2 = -0.6
PKY1 = -15.3
PKY2 = 1.7
PKY3 = 0.37
PKY6 = -0.9
PHY1 = -0.002
PVY1 = 0.036
PVY3 = -0.16
RBX1 = 13
RBX2 = 9.7
RCX1 = 1
RBY1 = 10.6
RBY2 = 7.8
RCY1 = 1.06
RVY1 = 0.05
RVY4 = 9.4
RVY5 = 1.9
RVY6 = 2.4
QSX2 = 1.2
QSX3 = 0.014
QSY1 = 0.007
QBZ1 = 12
QBZ5 = -0.15
QBZ9 = 3.4
QCZ1 = 1.3
QDZ1 = 0.09
QDZ3 = 0.38
QDZ6 = 0.0017
QDZ8 = -0.14
QEZ1 = -1.8
QHZ1 = 0.0014
SSZ1 = 0.009
)";

ElementExample magic_tyre_example(std::size_t regime, ExampleNumbers& numbers) {
  MagicFormulaTyre f;
  TirFile file = parse_tir(magic_example_text, "example");
  for (const char* keyword : {"PKX1", "PKY1", "PDX1", "PDY1", "VERTICAL_STIFFNESS", "QDZ1"})
    file.entries.find(keyword)->second.number *= numbers(0.9, 1.1);
  f.file = "example";
  f.form = numbers(0.0, 1.0) < 0.5 ? SlipForm::manual : SlipForm::book;
  f.friction = numbers(0.8, 1.0);
  f.damping = numbers(1.0, 5.0);
  f.side = static_cast<RollingRegime>(regime) == RollingRegime::other_side ? TyreSide::right
                                                                           : TyreSide::left;
  return rolling_example<MagicTyreLaw>(regime, numbers, f, magic_tyre_data(file, f),
                                       numbers(0.05, 0.12));
}

void magic_tyre_note(const Element& element, const SystemMotion& start,
                     std::vector<std::string>& notes) {
  note_rolling_tyre(element, keys_of_tyre<MagicTyreLaw>(element),
                    radius_of_tyre<MagicTyreLaw>(element), start, notes);
  for (const std::string& note : data_of<MagicTyreData>(element).notes)
    notes.push_back("tyre '" + element.name + "': " + note);
}

constexpr ElementKind magic_tyre_kind() {
  ElementKind kind = rolling_tyre_kind<MagicTyreLaw>();
  kind.about = "Magic Formula 5.2, 6.1 or 6.2 with the coefficients of a tyre property file";
  kind.keys = magic_tyre_keys;
  kind.build = magic_tyre_build;
  kind.note = magic_tyre_note;
  return kind;
}

}  // namespace

constinit const ElementKind magic_formula_tyre_element = magic_tyre_kind();

constinit const ExampleMaker magic_formula_tyre_examples = magic_tyre_example;

}  // namespace floatframe
