#pragma once
// The content of a model file as plain values, for programs that change models: numbers, texts,
// truth values, lists and maps as they are written, expressions (`${...}`) as their texts.
#include <cstdint>
#include <string>
#include <vector>

namespace floatframe {

struct ModelValue {
  enum class Kind {
    nothing,  ///< as of a key without a value
    truth,
    whole,  ///< without a point or an exponent
    number,
    text,
    list,
    map
  };
  Kind kind = Kind::nothing;
  bool truth = false;
  std::int64_t whole = 0;
  double number = 0.0;
  std::string text = {};
  std::vector<ModelValue> items = {};  ///< of a list or a map
  std::vector<std::string> keys = {};  ///< of a map, in the order of the file: of each item
};

/// The values in the text of a model file; `file` is its name in messages. Nothing of what they
/// mean is checked. Throws InputError with every error of the syntax.
ModelValue model_values(const std::string& text, const std::string& file);

}  // namespace floatframe
