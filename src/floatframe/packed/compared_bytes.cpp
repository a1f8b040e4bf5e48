// Descriptions as bytes that are compared and not kept.
#include "floatframe/packed/description_bytes.hpp"
#include "floatframe/packed/pass_model.hpp"

namespace floatframe {

DescriptionBytes bytes_without_formula_texts(const ModelDescription& description) {
  // A writer passes the same functions as a reader, but changes nothing.
  auto& d = const_cast<ModelDescription&>(description);
  ByteWriter s;
  s.formula_texts = false;
  pass(s, d);
  DescriptionBytes out;
  out.bodies = std::uint32_t(s.bytes.size());
  for (BodyDescription& b : d.bodies) {
    all(s, b.mirror, b.X_WT);
    if (auto* rigid = std::get_if<RigidDescription>(&b.kind))
      pass(s, rigid->shape);
    else if (auto* reduced = std::get_if<FlexibleBody>(&b.kind))
      pass(s, *reduced);
    else
      pass(s, std::get<FlexibleDescription>(b.kind));
  }
  out.bytes = std::move(s.bytes);
  out.doubles = std::move(s.doubles);
  return out;
}

}  // namespace floatframe
