// A transfer function of order 6 behind noise, against SciPy (tests/data/blocks).
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "support/completed_run.hpp"
#include "support/model_text.hpp"
#include "support/reference_json.hpp"

namespace floatframe::test {
namespace {

TEST(LinearBlock, OfOrderSixBehindNoiseIsThatOfLsim) {
  const Json data = read_json(FLOATFRAME_TEST_DATA "/blocks/lsim_of_noise.json");
  const double dt = data["interval_s"];
  const VecX u = to_vector(data["noise"]), y = to_vector(data["response"]);
  const Model model = model_of(fmt::format(
      R"(
bodies: {{box: {{position: [0, 0, 0], rigid: {{mass: 1}}}}}}
joints: {{slide: {{type: prismatic, child: box, at: [0, 0, 0], axis: x}}}}
controllers:
  b:
    type: transfer_function
    initial: zero
    input: {{formula: 'noise({0}, {1})'}}
    numerator: {2}
    denominator: {3}
outputs: {{u: {{formula: 'noise({0}, {1})'}}, y: {{controller: b}}}}
simulation: {{step: {1}, duration: {4}, output_interval: {1}}}
)",
      data["seed"].get<int>(), dt, data["numerator"].dump(), data["denominator"].dump(),
      dt * static_cast<double>(u.size() - 1)));
  for (const Coordinates c : both_coordinates) {
    std::vector<double> errors;
    for (const double h : {dt / 5, dt / 10, dt / 20}) {
      SimulationDescription o = model.simulation;
      o.coordinates = c;
      o.step = h;
      const ResultTable table = completed_run(model, o).table;
      ASSERT_EQ(table.rows(), data["noise"].size());
      double sum = 0.0;
      for (std::size_t k = 0; k < table.rows(); ++k) {
        const auto i = static_cast<Eigen::Index>(k);
        EXPECT_NEAR(table.at(k, 1), u[i], 1e-9);  // t = k dt is rounded
        sum += std::pow(table.at(k, 2) - y[i], 2);
      }
      errors.push_back(std::sqrt(sum) / y.norm());
    }
    fmt::print("[ figure ] {}: difference from lsim / norm {:.3e} {:.3e} {:.3e}\n", name_of(c),
               errors[0], errors[1], errors[2]);
    EXPECT_LT(errors[2], 1e-3);
    for (const int k : {0, 1}) EXPECT_NEAR(errors[k] / errors[k + 1], 4.0, 0.3);
  }
}

}  // namespace
}  // namespace floatframe::test
