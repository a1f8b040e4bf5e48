#pragma once
// Keywords of tyre property files: their dimension, and what they are where a file lacks them.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace floatframe {

enum class TirDimension : unsigned char {
  none,
  length,
  speed,
  angle,
  mass,
  inertia,
  force,
  stiffness,
  damping,
  pressure,
  per_length,
  word
};

struct TirKeyword {
  TirDimension dimension = TirDimension::none;
  double fallback = 0.0;
  bool scale = false;  ///< of [SCALING_COEFFICIENTS]
  bool used = true;    ///< read but without effect: turn slip, belt, road enveloping
};

/// Nothing for an unknown keyword; in capital letters.
std::optional<TirKeyword> tir_keyword(std::string_view keyword);
/// All of them, for "did you mean".
const std::vector<std::string>& tir_keyword_names();

/// Value of one unit in SI: "mm" -> 0.001 for `length`. Nothing for an unknown word.
std::optional<double> tir_unit(TirDimension quantity, std::string_view word);
/// Words that `tir_unit` knows, for messages.
std::string tir_unit_words(TirDimension quantity);

}  // namespace floatframe
