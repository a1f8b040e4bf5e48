#pragma once
// What a handle of the C interface is opened from.
#include <optional>
#include <span>
#include <string>

#include "floatframe/model/model.hpp"
#include "floatframe/packed/packed_model.hpp"

namespace floatframe {

/// A packed model, whose parameters take new values; or a model alone.
struct OpenedModel {
  std::optional<PackedModel> packed;
  Model model;  ///< built, with the values of the file
};

/// A packed model from its bytes. Throws InputError.
OpenedModel opened_bytes(std::span<const std::byte> bytes);

/// A model file or a packed model from its file. Throws InputError. Alone in its source: programs
/// that take packed models only (FMUs) do without it and the readers of model files.
OpenedModel opened_file(const std::string& path);

}  // namespace floatframe
