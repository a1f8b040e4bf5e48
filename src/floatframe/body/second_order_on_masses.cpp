#include "floatframe/body/second_order_on_masses.hpp"

namespace floatframe {

std::shared_ptr<const SecondOrder> second_order_on_masses(const FlexibleBody& body, bool stiffens) {
  if (body.modes() == 0) return nullptr;
  if (!stiffens || !body.second_order) return body.turning;
  if (!body.turning) return body.second_order;
  auto sum = std::make_shared<SecondOrder>(*body.second_order);
  for (std::size_t j = 0; j < 3; ++j) {
    sum->S2[j] += body.turning->S2[j];
    for (std::size_t i = 0; i < 3; ++i) sum->S2i[i][j] += body.turning->S2i[i][j];
  }
  return sum;
}

}  // namespace floatframe
