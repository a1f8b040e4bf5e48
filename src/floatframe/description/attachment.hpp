#pragma once
// Places on bodies and signals over time, as the user names them: what joints, rods, elements and
// outputs are attached to and driven by.
#include <optional>
#include <string>
#include <vector>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/formulas/formula.hpp"
#include "floatframe/math/piecewise_polynomial.hpp"
#include "floatframe/math/types.hpp"

namespace floatframe {

inline constexpr const char* ground_name = "ground";

/// A point on a body. With `node` a named node of a flexible body; otherwise `point`, on a flexible
/// body one of its nodes or else the origin of its frame, which no mode moves (within 1e-6 m).
struct AttachmentDescription {
  std::string body = ground_name;
  Vec3 point = Vec3::Zero();  ///< design configuration [m]
  std::optional<std::string> node;
  Origin origin;
};

/// A sine, or a chirp if it has a rate: with s = t - start and c = s within [0, duration],
///   amplitude sin(2 pi (frequency s + rate c (s - c / 2)) + phase)
/// Its frequency goes from `frequency` at the start to `frequency + rate duration`, and is constant
/// before and after.
struct SineTerm {
  double amplitude = 0.0, frequency = 0.0, phase = 0.0;  ///< [-, Hz, rad]
  double rate = 0.0, start = 0.0, duration = 0.0;        ///< [Hz/s, s, s]
};

/// A function of time: polynomial pieces plus sines. With a period the pieces between their first
/// break and a period later repeat, before and after.
struct TimeFunction {
  PiecewisePolynomial pieces;
  std::vector<SineTerm> sines = {};
  double period = 0.0;  ///< of the pieces; 0: none [s]
  /// Added: of the time `t`; of a signal also of measures, inputs and results of elements.
  SharedFormula formula = {};
};

/// A result of an element that is a signal: of a force element its force, length or rate, or of a
/// controller its value. The words are those of model files.
enum class SignalSource { none, force, length, rate, controller };
inline constexpr const char* signal_source_words[] = {"none", "force", "length", "rate",
                                                      "controller"};

/// The signal of a load, an actuator, a motor or a controller: a function of time, plus the value
/// of an input if one is named, plus a factor times a result of an element if one is named.
struct SignalDescription : TimeFunction {
  std::string input;
  SignalSource source = SignalSource::none;
  std::string element;  ///< of the source
  std::string value;    ///< of an element with several: its name, or its number from 1
  double factor = 1.0;

  SignalDescription() = default;
  explicit SignalDescription(const TimeFunction& f) : TimeFunction(f) {}
};

}  // namespace floatframe
