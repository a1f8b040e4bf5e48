#include "floatframe/export/morph_targets.hpp"

#include <algorithm>

#include "floatframe/history/history_content.hpp"

namespace floatframe {
namespace {

double largest_move(const VecX& field) {
  double out = 0.0;
  for (Eigen::Index k = 0; k + 2 < field.size(); k += 3)
    out = std::max(out, field.segment<3>(k).norm());
  return out;
}

}  // namespace

std::vector<MorphTarget> morph_targets(const BodyPicture& picture, const FlexibleBody& body,
                                       const std::vector<const std::vector<double>*>& amplitudes) {
  std::vector<MorphTarget> out;
  if (picture.modes.size() == 0) return out;
  const auto nm = static_cast<std::size_t>(body.modes());
  const auto keep_direction = [&](MorphTarget target, double sign) {
    target.sign = sign;
    double largest = 0.0;
    for (const std::vector<double>* y : amplitudes)
      for (std::size_t k = 0; k + nm <= y->size(); k += nm)
        largest = std::max(largest, target.weight(y->data() + k));
    target.scale = largest;
    target.field *= sign * largest;
    if (sign < 0.0) target.name += ", negative";
    if (largest_move(target.field) > least_target) out.push_back(std::move(target));
  };
  const auto keep = [&](const MorphTarget& target) {
    keep_direction(target, 1.0);
    keep_direction(target, -1.0);
  };
  const int modes = body.modes();
  const std::vector<std::string> names = names_of_modes(body);
  for (int a = 0; a < modes; ++a)
    keep({a, -1, 1.0, 1.0, names[static_cast<std::size_t>(a)], picture.modes.col(a)});
  if (picture.bent.empty()) return out;
  for (int a = 0; a < modes; ++a)
    for (int b = 0; b <= a; ++b) {
      MorphTarget target{
          a,
          b,
          1.0,
          1.0,
          names[static_cast<std::size_t>(a)] + " x " + names[static_cast<std::size_t>(b)],
          VecX::Zero(picture.modes.rows())};
      for (const BodyPicture::Bent& bent : picture.bent)
        for (int j = 0; j < 3; ++j)
          target.field[3 * bent.point + j] =
              (a == b ? 0.5 : 1.0) * bent.node->h[static_cast<std::size_t>(j)](a, b);
      keep(std::move(target));
    }
  return out;
}

}  // namespace floatframe
