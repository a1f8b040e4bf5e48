#pragma once
// A force as a function that a program gives, F(x, v, t): the law of the element `force_law`.
#include <concepts>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "floatframe/formulas/formula.hpp"

namespace floatframe {

/// What such a function returns: the force, and its derivatives if it knows both.
struct ForceLawValue {
  ForceLawValue(double value) noexcept : force(value) {}  // NOLINT: a number is a force
  ForceLawValue(double value, double by_x, double by_v) noexcept
      : force(value), dx(by_x), dv(by_v) {}
  double force;              ///< F [N] or [N m]
  std::optional<double> dx;  ///< dF/dx [N/m] or [N m/rad]; absent: by differences
  std::optional<double> dv;  ///< dF/dv [N s/m] or [N m s/rad]; absent: by differences
};

/// The function F(x, v, t): length or coordinate x [m] or [rad], its rate v, time t [s]. It is
/// called in every iteration of every step, also of steps that are repeated, and in several threads
/// if simulations of the model are: the same arguments must give the same force. A result that is
/// not finite lets the step be repeated in smaller parts; an exception ends it.
class ForceFunction {
 public:
  using Law = std::function<ForceLawValue(double x, double v, double t)>;

  ForceFunction() = default;
  /// `label`: saved states are accepted by models whose function has the same label. Without one
  /// only by models with a copy of this object.
  template <std::invocable<double, double, double> F>
  ForceFunction(F law, std::string label = "")  // NOLINT: a function is one
      : ForceFunction(Law(std::move(law)), std::move(label), 0) {}
  /// A name in a model file, in place of a function that a program is to give.
  static ForceFunction named(std::string name) { return {nullptr, std::move(name), 0}; }

  /// By a formula of x, v and t, with its exact derivatives; two with the same text are the same
  /// function. InputError if it refers to anything else.
  static ForceFunction of(const SharedFormula& formula);
  /// nullptr: it has none.
  const SharedFormula& formula() const noexcept { return formula_; }

  explicit operator bool() const noexcept { return law_ != nullptr; }
  ForceLawValue operator()(double x, double v, double t) const { return law_(x, v, t); }
  /// The label, or a text that no other function has.
  const std::string& identity() const noexcept { return identity_; }

 private:
  ForceFunction(Law law, std::string label, int);
  Law law_;
  SharedFormula formula_;
  std::string identity_;
};

}  // namespace floatframe
