#include "floatframe/model_file/changed_entity.hpp"

#include <cstring>

#include "floatframe/model_file/description_numbers.hpp"

namespace floatframe {
namespace {

using Pair = std::optional<std::pair<double, double>>;

bool differ(const ModelDescription& a, const ModelDescription& b, const Pair& numbers) {
  const DescriptionBytes x = bytes_without_formula_texts(a), y = bytes_without_formula_texts(b);
  if (!numbers) return x.bytes != y.bytes;
  for (std::size_t k = 0; k < std::min(x.doubles.size(), y.doubles.size()); ++k)
    if (number_at(x, k) == numbers->first && number_at(y, k) == numbers->second) return true;
  return false;
}

template <class List>
std::string changed_one(const char* word, List list, const ModelDescription& a,
                        const ModelDescription& b, const Pair& numbers) {
  const auto &x = a.*list, &y = b.*list;
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) {
    ModelDescription one, other;
    one.*list = {x[k]};
    other.*list = {y[k]};
    if (differ(one, other, numbers)) return std::string("the ") + word + " '" + x[k].name + "'";
  }
  return {};
}

}  // namespace

std::string changed_entity(const ModelDescription& a, const ModelDescription& b,
                           const Pair& numbers) {
  using D = ModelDescription;
  for (const std::string& text : {changed_one("body", &D::bodies, a, b, numbers),
                                  changed_one("joint", &D::joints, a, b, numbers),
                                  changed_one("rod", &D::rods, a, b, numbers),
                                  changed_one("constraint", &D::constraints, a, b, numbers),
                                  changed_one("coupling", &D::couplings, a, b, numbers),
                                  changed_one("controller", &D::controllers, a, b, numbers),
                                  changed_one("force", &D::forces, a, b, numbers),
                                  changed_one("road", &D::roads, a, b, numbers),
                                  changed_one("input", &D::inputs, a, b, numbers),
                                  changed_one("output", &D::outputs, a, b, numbers)})
    if (!text.empty()) return text;
  return "the model";
}

}  // namespace floatframe
