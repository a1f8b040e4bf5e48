#pragma once
// Packed models. Head and checksum would keep every change away from the reader: an input is what
// stands behind the head, which is that of a valid model and made to fit. A seed is a packed model
// without its first 40 bytes: tail -c +41 model.ffm
#include <algorithm>
#include <string_view>
#include <vector>

#include "floatframe/packed/packed_model.hpp"
#include "models.hpp"

namespace floatframe::fuzz {

inline std::vector<std::byte> packed_file(std::string_view sections) {
  static const std::vector<std::byte> valid = [] {
    ModelDescription d;
    d.bodies.emplace_back();
    d.bodies[0].name = "body";
    d.bodies[0].kind = RigidDescription{1.0, Vec3::Zero(), Mat3::Identity()};
    return PackedModel(d, {}).to_bytes();
  }();
  std::vector<std::byte> bytes(valid.begin(), valid.begin() + 40);
  for (const char c : sections) bytes.push_back(static_cast<std::byte>(c));
  seal_packed_model(bytes);
  return bytes;
}

/// What is read, and built if it is small, or refused with an InputError.
inline void packed(std::string_view bytes) {
  const PackedModel model = PackedModel::from_bytes(packed_file(bytes));
  const ModelDescription d = model.description();
  const bool few_modes = std::all_of(d.bodies.begin(), d.bodies.end(), [](const auto& body) {
    const auto* flexible = std::get_if<FlexibleBody>(&body.kind);
    return !flexible || flexible->modes() <= 50;
  });
  if (!few_modes || d.bodies.size() > 40) return;
  model.build();
  const std::vector<double> values(model.parameters().size(), 1.0);
  if (!values.empty()) model.build(values);
}

/// Those that need what a model is made of.
inline constexpr Reader model_readers[] = {model_reader, {"packed", packed, 16e6}};

}  // namespace floatframe::fuzz
