#pragma once
// Result of the command `response`, and its output: tables, JSON, CSV, plots.
#include <complex>
#include <optional>
#include <string>
#include <vector>

#include "floatframe/linear/road_response.hpp"

namespace floatframe {

/// Frequency response from one input to one output.
struct ResponseCurve {
  Column output, input;
  std::vector<std::complex<double>> values;
  std::string unit() const;  ///< "m/s2 per m"
};

/// Outputs in steady motion under an input amplitude cos(2 pi f t).
struct HarmonicResponse {
  std::string input, unit;
  double amplitude = 0.0, frequency = 0.0;
  std::vector<Column> outputs;
  std::vector<double> means;
  std::vector<std::complex<double>> values;
};

struct ResponseResult {
  std::string model;
  double time = 0.0;
  std::vector<double> frequencies;
  std::vector<ResponseCurve> curves;
  std::vector<HarmonicResponse> harmonics;
  RoadLoading loading;
  std::optional<RoadResponse> road;
  std::vector<std::string> notes;
  std::vector<std::string> stiffened;  ///< as in LinearSystem
  std::string stiffening;
};

std::string response_text(const ResponseResult& r);
std::string response_json(const ResponseResult& r);
std::string response_csv(const ResponseResult& r);
std::string response_svg(const ResponseResult& r);

}  // namespace floatframe
