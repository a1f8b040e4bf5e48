// Laws of springs, dampers and loads: functions of a length, rate, angle or time.
#include <algorithm>
#include <cmath>

#include "floatframe/description/rules.hpp"
#include "floatframe/description/sentences.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"
#include "floatframe/model_file/linear_file.hpp"
#include "floatframe/model_file/read_parts.hpp"
#include "floatframe/model_file/time_terms.hpp"
#include "floatframe/yaml/read_table.hpp"

namespace floatframe {
namespace {

std::vector<double> coefficients(const YamlValue& value) {
  const auto c = value.numbers(1, rules::most_coefficients, any_number(""), rules::coefficients);
  return c.value_or(std::vector<double>{0.0});
}

PiecewisePolynomial read_piecewise(const YamlValue& value, const LawUnits& units) {
  std::vector<double> breaks;
  std::vector<PiecewisePolynomial::Piece> pieces;
  const std::vector<YamlValue> items = value.list("a list of pieces {below: x, polynomial: [...]}");
  if (value.is_list() && items.empty())
    value.unexpected("a list of pieces {below: x, polynomial: [...]}");
  bool good = !items.empty();
  for (std::size_t i = 0; i < items.size(); ++i) {
    auto piece = items[i].section("a piece {below: x, polynomial: [...]}");
    if (!piece) return {};
    const bool last = i + 1 == items.size();
    if (!last) {
      const auto below = piece->require("below");
      const auto x = below ? below->number(any_number(units.x)) : std::nullopt;
      if (!x) good = false;
      if (x && !breaks.empty() && *x <= breaks.back())
        below->unexpected("a number above the previous one, " + number_text(breaks.back())),
            good = false;
      breaks.push_back(x.value_or(breaks.empty() ? 0.0 : breaks.back() + 1.0));
    } else if (const auto below = piece->get("below")) {
      below->error(ErrorCode::missing, "the last piece has no upper end, expected no key 'below'");
    }
    const auto p = piece->require("polynomial");
    good = good && p;
    const double about = piece->number("about", any_number(units.x), 0.0);
    pieces.push_back({about, p ? coefficients(*p) : std::vector<double>{0.0}});
    piece->finish();
  }
  if (!good) return {};
  const PiecewisePolynomial f(breaks, std::move(pieces));
  if (const auto jump = sentences::jump(f))
    items[jump->first].error(ErrorCode::contradiction, jump->second);
  return f;
}

/// The argument of a table.
enum class TableOf {
  measure,  ///< a spring or a damper: continues along its tangents
  time,     ///< holds its end values, and may jump
  motion,   ///< function of time without jumps, for motions
  velocity  ///< of a motion: without jumps, too
};

constexpr const char* no_jump(TableOf of) {
  return of == TableOf::motion     ? "a motion cannot jump"
         : of == TableOf::velocity ? "the velocity of a motion cannot jump"
                                   : nullptr;
}

/// Error of a point relative to those before it; empty if there is none.
std::string table_point_error(const std::vector<TablePoint>& before, double x, TableOf of,
                              const char* x_unit) {
  if (before.empty() || x > before.back().x) return {};
  const bool equal = x == before.back().x;
  if (of == TableOf::time && equal) {
    if (before.size() < 2 || before[before.size() - 2].x < x) return {};
    return "found x = " + number_text(x) + " [" + x_unit +
           "] a third time, expected at most two points at a jump";
  }
  return "found x = " + number_text(x) + " after " + number_text(before.back().x) +
         ", expected ascending x [" + x_unit + "]" +
         (equal && no_jump(of) ? std::string(": ") + no_jump(of) : std::string());
}

PiecewisePolynomial read_table(YamlSection& section, const YamlValue& value, Interpolation usual,
                               TableOf of, const char* x_unit, double* period = nullptr) {
  Interpolation interpolation = usual;
  constexpr const char* words[] = {"linear", "cubic"};
  section.word("interpolation", words, interpolation);
  const TableRows table = read_table_rows(value, any_number(""), "a point [x, f]",
                                          of == TableOf::measure ? "x" : "time");
  bool good = table.good;
  if (value.is_list() && value.node().items.size() < 2) {
    value.unexpected("a table of at least 2 points [x, f]");
    good = false;
  } else if (good && table.rows.size() < 2) {
    value.error(ErrorCode::wrong_count, "found " + std::to_string(table.rows.size()) +
                                            (table.rows.size() == 1 ? " row in '" : " rows in '") +
                                            table.file +
                                            "', expected a table of at least 2 points");
    good = false;
  }
  std::vector<TablePoint> points;
  for (const TableRow& row : table.rows) {
    if (const std::string text = table_point_error(points, row.point.x, of, x_unit);
        !text.empty()) {
      table.error(ErrorCode::wrong_value, row, text);
      good = false;
    }
    points.push_back(row.point);
  }
  if (period) {
    const double width = points.size() < 2 ? 1.0 : points.back().x - points.front().x;
    *period = read_period(section, good ? width : 1.0);
  }
  if (!good) return {};
  PiecewisePolynomial f = of == TableOf::measure
                              ? table_function(points, interpolation, Beyond::tangent)
                              : time_table(points, interpolation, period ? *period : 0.0);
  std::size_t piece = 0;
  for (std::size_t k = 1; k < points.size(); ++k) {
    if (points[k].x == points[k - 1].x) continue;  // a jump: no piece
    ++piece;                                       // between points k - 1 and k
    for (const double c : f.pieces()[piece].coefficients)
      if (!std::isfinite(c)) {
        table.error(ErrorCode::not_finite, table.rows[k],
                    "found the step from " + number_text(points[k - 1].f) + " to " +
                        number_text(points[k].f) + " over " +
                        number_text(points[k].x - points[k - 1].x) + " [" + x_unit +
                        "], expected a slope that is a finite number");
        return {};
      }
  }
  return f;
}

constexpr const char* time_laws =
    "a number or a map with one of formula, polynomial, piecewise, table, steps, and sine, chirp";

constexpr const char* motion_laws =
    "a number or a map with velocity, acceleration or one of formula, polynomial, piecewise, "
    "table, and "
    "sine, chirp";

/// The keys of a function of time; an error with `expected` if there are none, unless it is null.
TimeFunction time_terms(const ModelInstance& self, YamlSection& section, const char* unit,
                        Interpolation table, TableOf of, const char* expected) {
  TimeFunction f;
  int laws = 0;
  const auto formula = section.get("formula");
  if (formula) f.formula = read_formula(self, *formula);
  if (f.formula && f.formula->is_of_time())
    if (const std::string why = fault_at(*f.formula, 0.0); !why.empty())
      formula->error(ErrorCode::wrong_value, why + " at t = 0 s");
  if (const auto v = section.get("polynomial")) {
    ++laws;
    f.pieces = PiecewisePolynomial(
        {}, {{section.number("about", any_number("s"), 0.0), coefficients(*v)}});
  }
  if (const auto v = section.get("piecewise")) {
    ++laws;
    f.pieces = read_piecewise(*v, {"s", unit, unit});
  }
  if (const auto v = section.get("table")) {
    ++laws;
    f.pieces = read_table(section, *v, table, of, "s", &f.period);
  }
  if (const auto v = section.get("steps")) {
    ++laws;
    f.pieces = read_steps(*v, section, f.period);
    if (no_jump(of)) v->error(ErrorCode::wrong_value, no_jump(of));
  }
  const bool sines = read_sines(section, unit, f.sines);
  if (f.period > 0.0 && !f.pieces.breaks().empty())
    if (const auto text = sentences::period(f, !no_jump(of)))
      section.get(section.has("period") ? "period" : "periodic")
          ->error(ErrorCode::contradiction, *text);
  const auto& entries = section.value().node().entries;
  const bool unknown_key = std::any_of(entries.begin(), entries.end(), [&](const YamlEntry& e) {
    return !section.was_asked(e.key);
  });
  section.finish();
  if (laws > 1 || (laws == 0 && !sines && !formula && !unknown_key && expected != nullptr))
    section.error(ErrorCode::wrong_count, "found " + std::to_string(laws) + " laws, expected " +
                                              (expected != nullptr ? expected : time_laws));
  return f;
}

TimeFunction constant(const YamlValue& value, const char* unit) {
  TimeFunction f;
  if (const auto c = value.number(any_number(unit)))
    f.pieces = PiecewisePolynomial::polynomial({*c});
  return f;
}

TimeFunction time_function(const ModelInstance& self, const YamlValue& value, const char* unit,
                           Interpolation table, TableOf of, const char* expected) {
  if (!value.is_map()) return constant(value, unit);
  auto section = value.section();
  return time_terms(self, *section, unit, table, of, expected);
}

}  // namespace

PiecewisePolynomial read_law(const YamlValue& value, double free, const LawUnits& units) {
  const std::string forms = "a number [" + std::string(units.slope) +
                            "] or a map with one of linear, polynomial, piecewise, table";
  if (!value.is_map()) {
    const NumberRule rule{"a number", units.slope};
    if (value.is_list() ||
        (value.is_scalar() && !value.looks_like_number() &&
         value.node().text.find("${") == std::string::npos &&
         classify_plain_scalar(value.node().text).kind == PlainScalar::Kind::text)) {
      value.unexpected(forms);
      return {};
    }
    const auto k = value.number(rule);
    return k ? PiecewisePolynomial::linear(*k, free) : PiecewisePolynomial();
  }
  auto section = value.section();
  PiecewisePolynomial f;
  int laws = 0;
  if (const auto v = section->get("linear")) {
    ++laws;
    if (auto s = v->section("a map with stiffness, free, preload")) {
      const double k = s->required_number("stiffness", any_number(units.slope), 0.0);
      const double x0 = s->number("free", any_number(units.x), free);
      const double f0 = s->number("preload", any_number(units.f), 0.0);
      f = PiecewisePolynomial({}, {{x0, {f0, k}}});
      s->finish();
    }
  }
  if (const auto v = section->get("polynomial")) {
    ++laws;
    const double about = section->number("about", any_number(units.x), 0.0);
    f = PiecewisePolynomial({}, {{about, coefficients(*v)}});
  }
  if (const auto v = section->get("piecewise")) {
    ++laws;
    f = read_piecewise(*v, units);
  }
  if (const auto v = section->get("table")) {
    ++laws;
    f = read_table(*section, *v, Interpolation::linear, TableOf::measure, units.x);
  }
  section->finish();
  if (laws != 1)
    section->error(ErrorCode::wrong_count,
                   "found " + std::to_string(laws) + " laws, expected " + forms);
  return f;
}

namespace {

/// A motion by its velocity or its acceleration, whose key has the value `profile`.
TimeFunction read_motion_profile(const ModelInstance& self, YamlSection& section,
                                 const YamlValue& profile, bool acceleration,
                                 const std::string& unit) {
  const std::string rate = unit + "/s", rate_2 = unit + "/s2";
  const char* own = acceleration ? rate_2.c_str() : rate.c_str();
  const double start = section.number("start", any_number(unit.c_str()), 0.0);
  const double speed =
      acceleration ? section.number("velocity_at_start", any_number(rate.c_str()), 0.0) : 0.0;
  section.finish();
  const TableOf of = acceleration ? TableOf::time : TableOf::velocity;
  const TimeFunction f = time_function(self, profile, own, Interpolation::linear, of, time_laws);
  if (f.period > 0.0 || f.formula ||
      std::any_of(f.sines.begin(), f.sines.end(),
                  [](const SineTerm& s) { return s.rate != 0.0; })) {
    profile.error(
        ErrorCode::wrong_value,
        "found a formula, a period or a chirp, expected a function with an exact integral: "
        "polynomial, piecewise, table or steps without them, and sine");
    return {};
  }
  return integral_of(acceleration ? integral_of(f, speed) : f, start);
}

}  // namespace

TimeFunction read_motion(const ModelInstance& self, const YamlValue& value, const char* unit,
                         Interpolation table) {
  if (!value.is_map()) return constant(value, unit);
  auto section = value.section();
  const auto velocity = section->get("velocity"), acceleration = section->get("acceleration");
  if (velocity && acceleration)
    acceleration->error(ErrorCode::exclusive, "expected either velocity or acceleration");
  if (velocity || acceleration)
    return read_motion_profile(self, *section, velocity ? *velocity : *acceleration, !velocity,
                               unit);
  return time_terms(self, *section, unit, table, TableOf::motion, motion_laws);
}

namespace {

/// The result of an element that a signal contains; true if one is named.
bool read_source(const ModelInstance& self, YamlSection& section, SignalDescription& signal) {
  for (const SignalSource source :
       {SignalSource::force, SignalSource::length, SignalSource::rate, SignalSource::controller}) {
    const auto value = section.get(signal_source_words[index_of(source)]);
    if (!value) continue;
    if (signal.source != SignalSource::none) {
      value->error(ErrorCode::exclusive, sentences::one_source(signal.source));
      continue;
    }
    signal.source = source;
    const auto name = self.reference(
        source == SignalSource::controller ? EntityKind::controller : EntityKind::force, *value);
    signal.element = name.value_or("");
    if (source != SignalSource::controller && source != SignalSource::force) continue;
    if (const auto v = section.get("output")) signal.value = read_value_name(*v);
  }
  if (signal.source == SignalSource::none) return false;
  signal.factor = section.number("factor", any_number(""), 1.0);
  return true;
}

}  // namespace

SignalDescription read_signal(const ModelInstance& self, const YamlValue& value, const char* unit,
                              Interpolation table) {
  SignalDescription signal;
  TimeFunction& function = signal;
  if (!value.is_map()) {
    function = constant(value, unit);
    return signal;
  }
  auto section = value.section();
  const auto input = section->get("input");
  if (input)
    if (const auto name = self.reference(EntityKind::input, *input)) signal.input = *name;
  const bool source = read_source(self, *section, signal);
  function = time_terms(
      self, *section, unit, table, TableOf::time,
      input || source
          ? nullptr
          : "a number or a map with input, controller, force, length, "
            "rate or one of formula, polynomial, piecewise, table, steps, and sine, chirp");
  return signal;
}

}  // namespace floatframe
