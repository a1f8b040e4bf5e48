#pragma once
// A model in one file, `model.ffm` (docs/packed-model.md): its description with flexible bodies
// that are already reduced, the hints that were found when it was packed, and parameters. It is
// built by the same `build_model` as that of a model file, so that both step with equal bits, and
// without YAML, finite elements or their reduction.
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "floatframe/formulas/formula.hpp"
#include "floatframe/model/model.hpp"
#include "floatframe/packed/description_bytes.hpp"

namespace floatframe {

/// A parameter that takes a new value without a build: numbers of the description are formulas of
/// it.
struct PackedParameter {
  std::string name, unit, about;
  double value = 0.0;
};

/// The number at an offset of the content is factor x formula(parameters). Names of the formula are
/// those of parameters.
struct PackedExpression {
  std::uint32_t formula = 0;
  std::uint32_t offset = 0;
  double factor = 1.0;
};

class PackedModel {
 public:
  /// InputError: no packed model, damaged, or of another version. What the description says is
  /// checked when it is asked for.
  static PackedModel from_bytes(std::span<const std::byte> bytes);
  /// Of a description whose flexible bodies are reduced, and the notes about it (`model_hints`).
  PackedModel(const ModelDescription& description, ModelHints hints);

  std::vector<std::byte> to_bytes() const;
  /// 16 hexadecimal digits, the checksum of the bytes: differs where they do.
  std::string fingerprint() const;

  /// Name of the model.
  const std::string& name() const noexcept { return name_; }
  /// Those of `model_hints` when it was packed.
  const ModelHints& hints() const noexcept { return hints_; }

  /// Its parameters, and the numbers of the content that follow from them; offsets are those of
  /// `content().doubles`. The content itself holds what follows from the values of `parameters`.
  /// InputError: a name that is none, an offset outside, a parameter given twice.
  void tune(std::vector<PackedParameter> parameters, std::vector<SharedFormula> formulas,
            std::vector<PackedExpression> expressions);
  const std::vector<PackedParameter>& parameters() const noexcept { return parameters_; }
  const std::vector<SharedFormula>& formulas() const noexcept { return formulas_; }
  const std::vector<PackedExpression>& expressions() const noexcept { return expressions_; }
  /// The place of a parameter in `parameters`; -1: none of that name.
  int find_parameter(std::string_view name) const noexcept;

  /// As `description_bytes` made it; `doubles` is empty if it comes from bytes.
  const DescriptionBytes& content() const noexcept { return content_; }

  /// The description with these values of the parameters, in their order; empty: those that were
  /// packed. InputError: another count, values that are not finite, a formula without a value.
  ModelDescription description(std::span<const double> values = {}) const;
  /// The model, built. InputError: as `description`, and as `build_model`.
  Model build(std::span<const double> values = {}) const;

 private:
  PackedModel() = default;
  std::vector<std::byte> with_values(std::span<const double> values) const;

  DescriptionBytes content_;
  std::string name_;
  ModelHints hints_;
  std::vector<PackedParameter> parameters_;
  std::vector<SharedFormula> formulas_;
  std::vector<PackedExpression> expressions_;
};

/// True for the first bytes of a packed model.
bool is_packed_model(std::span<const std::byte> bytes) noexcept;

/// Reads a file. InputError with its name: as `from_bytes`, and if it cannot be read.
PackedModel read_packed_model(const std::string& path);

/// The checksum again, after bytes have been changed: for tests that damage more than it.
void seal_packed_model(std::span<std::byte> bytes) noexcept;

}  // namespace floatframe
