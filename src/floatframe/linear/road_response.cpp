#include "floatframe/linear/road_response.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "floatframe/core/diagnostics.hpp"
#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/linear/frequency_response.hpp"

namespace floatframe {
namespace {

/// Number of points of the frequency integral, uniform on a logarithmic axis.
constexpr int least_points = 4000;

/// (1) at a frequency, ignoring the band.
double density_of(const RoadLoading& loading, double f) {
  return loading.roughness *
         std::pow(f / loading.speed / road_classes::reference, -loading.waviness) / loading.speed;
}

/// S_y / S of each output: (2).
VecX road_gains(const FrequencyResponse& response, const LinearModel& linear,
                const std::vector<int>& road_of_input, double speed, double f) {
  const Eigen::MatrixXcd G = response.at_frequency(f);
  std::map<int, Eigen::VectorXcd> sums;
  for (Eigen::Index k = 0; k < G.cols(); ++k) {
    const auto at = static_cast<std::size_t>(k);
    const double phase = 2.0 * std::numbers::pi * f * linear.inputs[at].place / speed;
    Eigen::VectorXcd& sum = sums[road_of_input[at]];
    if (sum.size() == 0) sum = Eigen::VectorXcd::Zero(G.rows());
    sum += std::polar(1.0, phase) * G.col(k);
  }
  VecX gains = VecX::Zero(G.rows());
  for (const auto& [road, sum] : sums) gains += sum.cwiseAbs2();
  return gains;
}

}  // namespace

std::vector<double> frequencies_between(double from, double to, int count) {
  std::vector<double> f;
  for (int k = 0; k < count; ++k)
    f.push_back(count == 1       ? from
                : k == count - 1 ? to
                                 : from * std::pow(to / from, k / static_cast<double>(count - 1)));
  return f;
}

RoadResponse road_response(const Model& model, const std::vector<std::string>& outputs,
                           const std::vector<double>& frequencies, const RoadLoading& loading,
                           const SimulationOptions& options) {
  LinearPorts ports{{}, outputs};
  std::vector<int> road_of_input;
  for (const LinearInput& input : linear_inputs(model)) {
    if (input.kind != LinearInput::Kind::road || input.wheels.size() != 1) continue;
    ports.inputs.push_back(input.name);
    road_of_input.push_back(model.elements[static_cast<std::size_t>(input.wheels[0])].road);
  }
  if (ports.inputs.empty())
    throw InputError(ErrorCode::missing, "the model has no tyres, and so nothing of a road");
  if (!(loading.speed > 0.0))
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("found a speed of {:g} m/s on a road, expected a positive number",
                                 loading.speed));
  const auto positive = [](double x) { return x > 0.0 && std::isfinite(x); };
  if (!positive(loading.roughness))
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("found a roughness of {:g} m3, expected a positive number", loading.roughness));
  if (!(loading.waviness >= 0.0 && loading.waviness <= 10.0))
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("found a waviness of {:g}, expected a number from 0 to 10", loading.waviness));
  if (!(loading.from >= 0.0) || !positive(loading.to))
    throw InputError(ErrorCode::out_of_range,
                     fmt::format("found a band from {:g} to {:g} Hz, expected positive numbers",
                                 loading.from, loading.to));
  RoadResponse r;
  r.from = std::max(loading.from, road_classes::low * loading.speed);
  r.to = std::min(loading.to, road_classes::high * loading.speed);
  if (!(r.to > r.from))
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format(
            "at {:g} m/s the road has waves from {:.4g} to {:.4g} Hz, none from {:g} to {:g} Hz",
            loading.speed, road_classes::low * loading.speed, road_classes::high * loading.speed,
            loading.from, loading.to));
  const LinearModel linear = linear_model(model, ports, options);
  const FrequencyResponse response(linear);
  r.notes = linear.system.notes;
  r.frequencies = frequencies;
  for (const Column& c : linear.outputs) r.outputs.push_back({c, {}, 0.0});
  for (const double f : frequencies) {
    const bool inside = f >= r.from * (1.0 - 1e-12) && f <= r.to * (1.0 + 1e-12);
    VecX density = VecX::Zero(linear.C.rows());
    if (inside)
      density =
          road_gains(response, linear, road_of_input, loading.speed, f) * density_of(loading, f);
    for (std::size_t k = 0; k < r.outputs.size(); ++k)
      r.outputs[k].density.push_back(density[static_cast<Eigen::Index>(k)]);
  }
  // int S df = int S f d(ln f), by the trapezoidal rule.
  const int count = std::max(least_points, static_cast<int>(frequencies.size()));
  const double h = std::log(r.to / r.from) / (count - 1);
  VecX squares = VecX::Zero(linear.C.rows());
  for (const double f : frequencies_between(r.from, r.to, count)) {
    const double weight = (f == r.from || f == r.to ? 0.5 : 1.0) * h * f * density_of(loading, f);
    squares += weight * road_gains(response, linear, road_of_input, loading.speed, f);
    r.road += weight;
  }
  for (std::size_t k = 0; k < r.outputs.size(); ++k)
    r.outputs[k].rms = std::sqrt(squares[static_cast<Eigen::Index>(k)]);
  r.road = std::sqrt(r.road);
  return r;
}

}  // namespace floatframe
