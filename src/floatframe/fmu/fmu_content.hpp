#pragma once
// What an FMU says of a model: its variables with names, units and start values, and facts for
// people. The same for both versions of the standard.
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "floatframe/model/model.hpp"
#include "floatframe/packed/packed_model.hpp"

namespace floatframe {

/// Value references, which the runtime counts too: the time, then number i of each kind at its
/// base.
enum class FmuReference : std::uint32_t {
  time = 0,
  inputs = 0x10000,
  outputs = 0x20000,
  parameters = 0x30000,
  figures = 0x40000
};

struct FmuVariable {
  std::string name;      ///< by the grammar of the standard, different from all others
  std::string original;  ///< in the model
  std::string about;
  std::string unit{};
  std::uint32_t reference = 0;
  std::optional<double> start{};
  std::optional<double> low{}, high{};  ///< limits
  bool fixed = false;                   ///< a parameter that is set before steps only
};

struct FmuContent {
  std::string model;                  ///< its name
  std::string identifier;             ///< its name for C and for files
  std::string token;                  ///< which the runtime compares with its packed model
  std::string time = "time";          ///< the name of the time
  double step = 0.0, duration = 0.0;  ///< [s]
  std::vector<FmuVariable> inputs, outputs, parameters, figures;
  std::vector<std::pair<std::string, std::string>> facts;  ///< "bodies", "17, of them 12 flexible"
  std::vector<std::string> notes;                          ///< of names that had to change
};

/// `parameters`: those that take a new value without a build; `token`: the fingerprint of the
/// packed model.
FmuContent fmu_content(const Model& model, std::span<const PackedParameter> parameters,
                       std::string token);

}  // namespace floatframe
