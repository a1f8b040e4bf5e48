#pragma once
// Short hands of the tests of runs: figures printed beside what they are held against, the four
// combinations of coordinates and inertia method, columns of a result, messages of runs that fail.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <exception>
#include <string>

#include "support/completed_run.hpp"

namespace floatframe::test {

inline void figure(const std::string& name, double value) {
  std::printf("[ figure ] %s %.10g\n", name.c_str(), value);
  std::fflush(stdout);
}

struct Combination {
  Coordinates coordinates = Coordinates::relative;
  InertiaMethod inertia = InertiaMethod::preprocessing;
  std::string name() const {
    return name_of(coordinates) +
           (inertia == InertiaMethod::preprocessing ? "_preprocessing" : "_projection");
  }
};

inline constexpr std::array<Combination, 4> combinations{
    {{Coordinates::relative, InertiaMethod::preprocessing},
     {Coordinates::relative, InertiaMethod::projection},
     {Coordinates::absolute, InertiaMethod::preprocessing},
     {Coordinates::absolute, InertiaMethod::projection}}};

inline SimulationDescription with(SimulationDescription s, const Combination& c, double step,
                                  double duration, double output_interval = 0.0) {
  s.coordinates = c.coordinates;
  s.inertia = c.inertia;
  s.step = step;
  s.duration = duration;
  s.output_interval = output_interval;
  return s;
}

inline RunResult run_of(const Model& model, const Combination& c) {
  const SimulationDescription& s = model.simulation;
  return run(model, with(s, c, s.step, s.duration));
}
inline RunResult completed_run(const Model& model, const Combination& c) {
  const SimulationDescription& s = model.simulation;
  return completed_run(model, with(s, c, s.step, s.duration));
}

/// The message of the error that `f` throws.
template <class Error = std::exception, class Function>
std::string message_of(Function&& f) {
  try {
    f();
  } catch (const Error& e) {
    std::printf("[ message ] %s\n", e.what());
    return e.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

inline void expect_in(const std::string& text, const std::string& part) {
  EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in: " << text;
}

inline std::size_t column(const ResultTable& table, const std::string& name) {
  for (std::size_t k = 0; k < table.columns.size(); ++k)
    if (table.columns[k].name == name) return k;
  ADD_FAILURE() << "no column " << name;
  return 0;
}

inline double entry(const ResultTable& table, std::size_t row, const std::string& name) {
  return table.at(row, column(table, name));
}

struct Extreme {
  double value = 0.0, time = 0.0;
};
inline Extreme maximum(const ResultTable& table, const std::string& name, double sign = 1.0) {
  const std::size_t k = column(table, name);
  Extreme e{-1e300, 0.0};
  for (std::size_t i = 0; i < table.rows(); ++i)
    if (sign * table.at(i, k) > e.value) e = {sign * table.at(i, k), table.at(i, 0)};
  e.value *= sign;
  return e;
}
inline Extreme minimum(const ResultTable& table, const std::string& name) {
  return maximum(table, name, -1.0);
}

/// Largest difference of one column over rows with time up to `until`.
inline double difference(const ResultTable& a, const ResultTable& b, const std::string& name,
                         double until = 1e300) {
  const std::size_t k = column(a, name);
  EXPECT_EQ(a.rows(), b.rows());
  double worst = 0.0;
  for (std::size_t i = 0; i < std::min(a.rows(), b.rows()) && a.at(i, 0) <= until + 1e-9; ++i)
    worst = std::max(worst, std::abs(a.at(i, k) - b.at(i, k)));
  return worst;
}

}  // namespace floatframe::test
