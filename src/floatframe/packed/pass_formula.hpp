#pragma once
// Formulas, functions of time, laws and roads as bytes. What evaluation takes for granted - the
// depth of the stack at each step, places of references, tables and switches, jumps that only go
// forwards - is checked when they are read.
#include <string>

#include "floatframe/description/attachment.hpp"
#include "floatframe/description/force_function.hpp"
#include "floatframe/formulas/function_words.hpp"
#include "floatframe/packed/byte_streams.hpp"
#include "floatframe/roads/road_surface.hpp"

namespace floatframe {

/// What is wrong with a formula of unknown origin; nullptr: it may be evaluated.
const char* formula_damage(const Formula& f);
const char* crg_damage(const CrgRoad& road);

template <class S>
void pass(S& s, PiecewisePolynomial& x) {
  std::vector<double> breaks = x.breaks();
  pass(s, breaks);
  std::vector<PiecewisePolynomial::Piece> pieces = x.pieces();
  if constexpr (S::reads) pieces.assign(1, {});
  for (std::size_t k = 0; k <= breaks.size(); ++k) {
    if (S::reads && k > 0) pieces.emplace_back();
    auto& [centre, coefficients] = pieces[k];
    all(s, centre, coefficients);
  }
  if constexpr (S::reads) {
    for (std::size_t k = 1; k < breaks.size(); ++k)
      s.require(breaks[k - 1] <= breaks[k], "breaks of a law that do not ascend");
    x = PiecewisePolynomial(std::move(breaks), std::move(pieces));
  }
}
template <class S>
void pass(S& s, GridTable& g) {
  auto& [x, y, values] = g;
  all(s, x, y, values);
  if constexpr (S::reads) {
    bool good =
        x.size() > 1 && y.size() > 1 && values.rows() == x.size() && values.cols() == y.size();
    for (const VecX* v : {&x, &y})
      for (Eigen::Index k = 1; k < v->size(); ++k) good = good && (*v)[k - 1] < (*v)[k];
    s.require(good, "a table that is no grid");
  }
}

template <class S>
void pass(S& s, SharedFormula& x);

template <class S>
void pass(S& s, FormulaReference& r) {
  auto& [function, name, detail, delayed, delay] = r;
  all(s, function, name, detail, delayed, delay);
}
template <class S>
void pass(S& s, FormulaStep& step) {
  auto& [op, index, number, function] = step;
  pass_word(s, op, FormulaOp::jump_unless);
  all(s, index, number);
  std::string name = function ? function->name : "";
  pass(s, name);
  if constexpr (S::reads) function = name.empty() ? nullptr : unary_function(name);
}
template <class S>
void pass(S& s, FormulaKink& k) {
  auto& [text, held, references] = k;
  all(s, text, held, references);
}
template <class S>
void pass(S& s, FormulaMirror& m) {
  auto& [P, t] = m;
  all(s, P, t);
}
template <class S>
void pass(S& s, Formula& f) {
  auto& [text, steps, sources, references, mirror, curves, grids, switches, kinks] = f;
  if constexpr (!S::reads)
    if (!s.formula_texts) {
      all(s, steps, references, mirror, curves, grids, switches, kinks);
      return;
    }
  all(s, text, steps, sources, references, mirror, curves, grids, switches, kinks);
  if constexpr (S::reads)
    if (const char* what = formula_damage(f)) s.damaged(what);
}
template <class S>
void pass(S& s, SharedFormula& x) {
  bool there = x != nullptr;
  pass(s, there);
  if (!there) {
    if constexpr (S::reads) x = nullptr;
    return;
  }
  if constexpr (S::reads) {
    s.require(++s.depth <= 8, "formulas that are nested too deeply");
    Formula f;
    pass(s, f);
    x = std::make_shared<const Formula>(std::move(f));
    --s.depth;
  } else {
    pass(s, const_cast<Formula&>(*x));  // a writer changes nothing
  }
}

template <class S>
void pass(S& s, SineTerm& x) {
  auto& [amplitude, frequency, phase, rate, start, duration] = x;
  all(s, amplitude, frequency, phase, rate, start, duration);
}
template <class S>
void pass(S& s, TimeFunction& x) {
  auto& [pieces, sines, period, formula] = x;
  all(s, pieces, sines, period, formula);
}
template <class S>
void pass(S& s, SignalDescription& x) {
  pass(s, static_cast<TimeFunction&>(x));
  pass(s, x.input);
  pass_word(s, x.source, SignalSource::controller);
  all(s, x.element, x.value, x.factor);
}
template <class S>
void pass(S& s, AttachmentDescription& x) {
  auto& [body, point, node, origin] = x;
  all(s, body, point, node, origin);
}
/// A formula, or the name of a function that a program gives later.
template <class S>
void pass(S& s, ForceFunction& x) {
  SharedFormula formula = x.formula();
  std::string name = formula ? "" : x.identity();
  if (!S::reads && x && !formula)
    throw InputError(ErrorCode::unsupported,
                     "found a force law that a program gives as a function, expected one by a "
                     "formula: functions cannot be packed");
  all(s, formula, name);
  if constexpr (S::reads)
    x = formula        ? ForceFunction::of(formula)
        : name.empty() ? ForceFunction()
                       : ForceFunction::named(name);
}

template <class S>
void pass(S& s, FrictionPatch& p) {
  auto& [x0, x1, y0, y1, friction] = p;
  all(s, x0, x1, y0, y1, friction);
}
/// The slopes follow from the heights.
template <class S>
void pass(S& s, HeightGrid& g) {
  auto& [x, y, interpolation, outside, z, zx, zy, zxy] = g;
  all(s, x, y);
  pass_word(s, interpolation, GridInterpolation::linear);
  pass_word(s, outside, GridOutside::refuse);
  pass(s, z);
  if constexpr (S::reads)
    g = height_grid(std::move(x), std::move(y), std::move(z), interpolation, outside);
}
template <class S>
void pass(S& s, CrgEdge& e) {
  auto& [mode, offset] = e;
  pass_word(s, mode, CrgBorder::reflect);
  pass(s, offset);
}
template <class S>
void pass(S& s, ReferenceLine& line) {
  ReferenceLine::Numbers x = line.numbers();
  auto& [u0, du, steps, nodes, start, heading] = x;
  all(s, u0, du);
  const std::uint64_t n = s.whole(steps);
  all(s, start.x, start.y, heading);
  const std::size_t count = s.count(nodes.size(), 16);
  if constexpr (S::reads) {
    s.require(du > 0.0 && n > 0 && n <= 1'000'000'000u && (count == 0 || count == n + 1),
              "a road without steps");
    steps = n;
    nodes.resize(count);
  }
  for (ReferenceLine::Node& p : nodes) all(s, p.x, p.y);
  if constexpr (S::reads) line = ReferenceLine(std::move(x));
}
template <class S>
void pass(S& s, CrgRoad& c) {
  auto& [line, v, uniform, singles, doubles, line_heights, banking, edge_u, edge_v, interpolation,
         notes] = c;
  all(s, line, v, uniform, singles, doubles, line_heights, banking, edge_u, edge_v);
  pass_word(s, interpolation, CrgInterpolation::cubic);
  pass(s, notes);
  if constexpr (S::reads)
    if (const char* what = crg_damage(c)) s.damaged(what);
}
template <class S>
void pass(S& s, TwoTracks& t) {
  auto& [left, right, width, centre] = t;
  all(s, left, right, width, centre);
  s.require(width > 0.0, "two tracks without a distance");
}
template <class S>
void pass(S& s, RoadSurface& r) {
  auto& [height, grid, crg, tracks, friction, patches] = r;
  all(s, height, grid, crg, tracks, friction, patches);
}

}  // namespace floatframe
