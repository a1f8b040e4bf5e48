#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/core/number_rule.hpp"
#include "floatframe/core/suggest.hpp"
#include "floatframe/formulas/formula_evaluation.hpp"

namespace floatframe {

std::string fault_text(const Formula& f, const FormulaFault& fault) {
  if (fault.kind == FormulaFault::Kind::none) return "";  // of no step
  const std::string& source = f.sources[fault.step];
  switch (fault.kind) {
    case FormulaFault::Kind::none:
      return "";
    case FormulaFault::Kind::division:
      return "division by zero in '" + source + "'";
    case FormulaFault::Kind::domain:
      return "'" + source + "' is not defined for " + number_text(fault.at);
    case FormulaFault::Kind::overflow:
      return "'" + source + "' is not a finite number";
  }
  return "";
}

namespace {

/// splitmix64
std::uint64_t mixed(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15u;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

/// A normal number of mean 0 and deviation 1 (Box-Muller) for each seed and k.
double normal_number(double seed, double k) noexcept {
  const auto at = [](std::uint64_t bits) {  // in (0, 1]
    return ((bits >> 11) + 1) * 0x1p-53;
  };
  const std::uint64_t a = mixed(mixed(std::llround(seed)) ^ std::llround(k));
  return std::sqrt(-2.0 * std::log(at(a))) * std::cos(2.0 * std::numbers::pi * at(mixed(a)));
}

/// The interval of x, and where x is in it.
struct GridPlace {
  Eigen::Index k;
  double part, width;  ///< width 0: beyond the ends
};
GridPlace place_in(const VecX& points, double x) noexcept {
  const Eigen::Index n = points.size();
  if (!(x > points[0])) return {0, 0.0, 0.0};
  if (x >= points[n - 1]) return {n - 2, 1.0, 0.0};
  const auto k = std::upper_bound(points.data(), points.data() + n, x) - points.data() - 1;
  const double width = points[k + 1] - points[k];
  return {k, (x - points[k]) / width, width};
}

}  // namespace

FunctionValue noise_at(double seed, double x) noexcept {
  const double k = std::floor(x), a = normal_number(seed, k), b = normal_number(seed, k + 1.0);
  return {a + (x - k) * (b - a), b - a};
}

GridValue grid_at(const GridTable& grid, double x, double y) noexcept {
  const GridPlace i = place_in(grid.x, x), j = place_in(grid.y, y);
  const double f00 = grid.values(i.k, j.k), f10 = grid.values(i.k + 1, j.k),
               f01 = grid.values(i.k, j.k + 1), f11 = grid.values(i.k + 1, j.k + 1);
  const double left = f00 + i.part * (f10 - f00), right = f01 + i.part * (f11 - f01);
  const double across = (f10 - f00) + j.part * ((f11 - f01) - (f10 - f00));
  return {left + j.part * (right - left), i.width > 0.0 ? across / i.width : 0.0,
          j.width > 0.0 ? (right - left) / j.width : 0.0};
}

namespace {

Jet jet_at(const Formula& f, double t, FormulaFault& fault) noexcept {
  FormulaSwitches switches;
  return evaluate_formula<Jet>(
      f, [&](int) { return Jet(t, 1.0); }, switches, fault);
}

}  // namespace

PiecewisePolynomial::Value formula_at(const Formula& f, double t) noexcept {
  FormulaFault fault;
  const Jet y = jet_at(f, t, fault);
  return {y.f, y.df, y.ddf};
}

std::uint64_t pieces_at(const Formula& f, double t) noexcept {
  FormulaSwitches switches;
  FormulaFault fault;
  evaluate_formula<double>(
      f, [t](int) { return t; }, switches, fault);
  return switches.pieces;
}

double piece_change(const Formula& f, double from, double to) noexcept {
  const std::uint64_t here = pieces_at(f, from);
  double low = from, high = low + 0.5 * (to - from);
  if (pieces_at(f, high) == here) {
    low = high;
    high = to;
    if (pieces_at(f, high) == here) return std::numeric_limits<double>::infinity();
  }
  for (double middle; (middle = low + 0.5 * (high - low)) > low && middle < high;)
    (pieces_at(f, middle) == here ? low : high) = middle;
  // There a sign or a difference may still be zero.
  return high + 2.0 * std::numeric_limits<double>::epsilon() * std::abs(high);
}

std::string fault_at(const Formula& f, double t) {
  FormulaFault fault;
  jet_at(f, t, fault);
  return fault_text(f, fault);
}

int used_table(Formula& f, const std::string& name, bool grid, const FormulaTables& tables) {
  const auto find = [&](const auto& known, const auto& others, auto& used) -> int {
    if (const auto it = known.find(name); it != known.end()) {
      used.push_back(it->second);
      return std::ssize(used) - 1;
    }
    std::vector<std::string> names;
    for (const auto& [key, value] : known) names.push_back(key);
    throw ExpressionError(
        others.contains(name)
            ? "the table '" + name + "' has " +
                  (grid ? "one variable, expected 'table'" : "two variables, expected 'table2'")
            : "unknown table '" + name + "'" + did_you_mean(name, names));
  };
  return grid ? find(tables.grids, tables.curves, f.grids)
              : find(tables.curves, tables.grids, f.curves);
}

std::string fold_last_step(Formula& f, int operands) {
  const auto n = std::ssize(f.steps), first = n - 1 - operands;
  Formula part;
  for (auto k = first; k < n; ++k) {
    part.steps.push_back(f.steps[k]);
    part.sources.push_back(f.sources[k]);
    if (k < n - 1 && f.steps[k].op != FormulaOp::number) return {};
  }
  FormulaSwitches switches;
  FormulaFault fault;
  const double value = evaluate_formula<double>(
      part, [](int) { return 0.0; }, switches, fault);
  if (fault.kind != FormulaFault::Kind::none) return fault_text(part, fault);
  std::string source = f.sources.back();
  f.steps.resize(first);
  f.sources.resize(first);
  f.steps.push_back({FormulaOp::number, -1, value, nullptr});
  f.sources.push_back(std::move(source));
  return {};
}

void add_kink(Formula& f, const std::string& word, std::ptrdiff_t first, int a_switch) {
  FormulaKink kink{word, a_switch < Formula::most_switches ? a_switch : -1, {}};
  for (auto at = first; at < std::ssize(f.steps); ++at)
    if (f.steps[at].op == FormulaOp::reference) kink.references.push_back(f.steps[at].index);
  if (!kink.references.empty()) f.kinks.push_back(std::move(kink));
}

bool jumps_at(const Formula& f, const FormulaKink& kink) noexcept {
  if (kink.held < 0 || !(kink.word == "sign" || std::strchr("<>", kink.word[0]))) return false;
  struct Side {
    double f, beyond;
  };
  const auto side = [&](int piece, double x) -> Side {
    FormulaSwitches switches;
    FormulaFault fault;
    switches.held = FormulaSwitches::with(0, kink.held, piece);
    const double y = evaluate_formula<double>(
        f,
        [&](int i) {
          const bool moves = std::ranges::find(kink.references, i) != kink.references.end();
          return moves ? x : 0.7 + 0.1 * i;
        },
        switches, fault);
    return {y, switches.beyond};
  };
  const double at_0 = side(1, 0.0).beyond, at_1 = side(1, 1.0).beyond;
  const double x = at_0 == at_1 ? 0.0 : at_0 / (at_0 - at_1);
  const double a = side(1, x).f, b = side(2, x).f;
  const double size = std::abs(side(1, x + 1.0).f) + std::abs(side(2, x - 1.0).f);
  return std::abs(b - a) > 1e-9 * (std::abs(a) + std::abs(b) + size);
}

bool Formula::is_of_time() const noexcept {
  return std::all_of(references.begin(), references.end(),
                     [](const FormulaReference& r) { return r.is_time(); });
}

SharedFormula formula(std::string_view text, const FormulaTables& tables) {
  try {
    return compile_formula(parse_expression(text), tables);
  } catch (const ExpressionError& e) {
    throw InputError(ErrorCode::wrong_value, "formula '" + std::string(text) + "': " + e.what());
  }
}

}  // namespace floatframe
