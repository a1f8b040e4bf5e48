// Kinks of laws, functions of time and roads that a run passed.
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "floatframe/model/constraint_part.hpp"
#include "floatframe/model/element_kind.hpp"
#include "support/mechanism_check.hpp"

namespace floatframe::test {

namespace {

/// Number of the kinks of f (jumps of its value or slope) below x.
int kinks_below(const PiecewisePolynomial& f, double x) {
  int count = 0;
  for (std::size_t k = 0; k < f.breaks().size() && f.breaks()[k] <= x; ++k) {
    const double at = f.breaks()[k];
    const PiecewisePolynomial::Value l = f.piece_value(k, at), r = f.piece_value(k + 1, at);
    if (std::abs(l.f - r.f) > 1e-9 * (1.0 + std::abs(l.f)) ||
        std::abs(l.df - r.df) > 1e-9 * (1.0 + std::abs(l.df)))
      ++count;
  }
  return count;
}

int kinks_in_time(const TimeFunction& f, double end) {
  return kinks_below(f.pieces, end) - kinks_below(f.pieces, 0.0);
}

/// Of a table of results: where a quantity of a force element is.
std::size_t column_of(const Model& model, OutputType quantity, std::size_t force) {
  for (std::size_t c = 0; c < model.outputs.size(); ++c)
    if (model.outputs[c].type == quantity && model.outputs[c].element == static_cast<int>(force))
      return c + 1;
  throw std::logic_error("the results do not hold all of force '" + model.elements[force].name +
                         "'");
}

}  // namespace

double steps_on_kinks(const Model& model, double steps) {
  const double end = model.simulation.duration;
  std::vector<double> kinks;
  const auto add = [&](const TimeFunction& f) {
    for (const double at : f.pieces.breaks())
      if (at > 0.0 && at < end) kinks.push_back(at);
  };
  for (const Element& f : model.elements)
    for (const Signal& signal : f.signals) add(signal.function);
  double best = steps;
  std::ptrdiff_t most = 0;
  for (int more = 0; more < 20; ++more) {
    const double n = steps + more;
    const std::ptrdiff_t met = std::count_if(kinks.begin(), kinks.end(), [&](double at) {
      const double place = at / end * n;
      return std::abs(place - std::round(place)) < 1e-9 * n;
    });
    if (met > most) {
      most = met;
      best = n;
    }
  }
  return best;
}

bool passes_kinks(const Model& model, const ResultTable& t) {
  for (std::size_t k = 0; k < model.elements.size(); ++k) {
    const Element& f = model.elements[k];
    const double end = model.simulation.duration;
    for (const Signal& signal : f.signals)
      if (kinks_in_time(signal.function, end)) return true;
    if (!f.acts || !element_has(f.type, ElementQuantity::length))
      continue;  // a load: time alone decides
    const std::size_t force_column = column_of(model, OutputType::force, k),
                      length_column = column_of(model, OutputType::length, k),
                      rate_column = column_of(model, OutputType::rate, k);
    const auto value = [&](std::size_t port, double time) {
      PiecewisePolynomial::Value x = evaluate(f.signals[port].function, time);
      if (f.signals[port].input >= 0) x.f += model.inputs[f.signals[port].input].initial;
      return x;
    };
    const auto side = [&](std::size_t row) {
      const double time = t.at(row, 0), force = t.at(row, force_column);
      double length = t.at(row, length_column), rate = t.at(row, rate_column);
      if (f.road >= 0 || element_kind(f.type).contact) return force != 0.0 ? 1 : 0;
      if (f.type == ElementType::joint_spring) {  // signals: actuator, target, target rate
        const PiecewisePolynomial::Value target = value(1, time);
        length -= target.f;
        rate -= f.signals[2].given ? value(2, time).f : target.df;
      }
      if (f.laws.size() != 2) return 0;
      return kinks_below(f.laws[0], length) + 100 * kinks_below(f.laws[1], rate);
    };
    for (std::size_t r = 1; r < t.rows(); ++r)
      if (side(r) != side(0)) return true;
    if (f.road >= 0 && side(0) == 1) {
      // The centre of a wheel stays within its speed times the time; edges of a road are kinks.
      const Road& road = model.roads[f.road];
      if (kinks_below(road.pieces, 1e9) > 0) return true;
    }
  }
  return false;
}

}  // namespace floatframe::test
