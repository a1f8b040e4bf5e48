// Response: of outputs to inputs over the frequency, in steady motion under a harmonic input, and
// to random roads.
#include <fmt/format.h>

#include <memory>

#include "floatframe/analyses/analysis.hpp"
#include "floatframe/analyses/response_result.hpp"
#include "floatframe/analyses/rotor_options.hpp"
#include "floatframe/analyses/unbalance_report.hpp"
#include "floatframe/core/json_text.hpp"
#include "floatframe/core/text_pieces.hpp"
#include "floatframe/core/work_progress.hpp"
#include "floatframe/description/road_spectrum.hpp"
#include "floatframe/linear/frequency_response.hpp"
#include "floatframe/linear/operating_point.hpp"

namespace floatframe {
namespace {

struct ResponseOptions {
  LinearPorts ports;
  std::string at;
  double from = 0.1, to = 50.0;
  int points = 400;
  std::vector<std::string> harmonic;
  std::string spectrum;
  double speed = 0.0, waviness = 2.0;
  std::string rotor, axis;
  std::vector<std::string> unbalance;
};

double roughness_of(const std::string& text) {
  for (int k = 0; k < static_cast<int>(std::size(road_classes::names)); ++k)
    if (text == road_classes::names[k]) return road_classes::roughness(k);
  const std::optional<double> value = finite_number(text);
  if (!value || !(*value > 0.0))
    throw InputError(ErrorCode::wrong_value,
                     fmt::format("--road-spectrum: found '{}', expected a class, A to H, or the "
                                 "roughness at 0.1 cycles/m [m3]",
                                 excerpt(text)));
  return *value;
}

/// "NAME=AMPLITUDE@HERTZ"
struct HarmonicRequest {
  std::string input;
  double amplitude, frequency;
};
HarmonicRequest harmonic_request(const std::string& text) {
  const std::size_t equals = text.rfind('='), at = text.rfind('@');
  if (equals != std::string::npos && at != std::string::npos && equals < at) {
    const auto amplitude = finite_number(text.substr(equals + 1, at - equals - 1)),
               frequency = finite_number(text.substr(at + 1));
    if (amplitude && frequency && *frequency >= 0.0)
      return {text.substr(0, equals), *amplitude, *frequency};
  }
  throw InputError(
      ErrorCode::wrong_value,
      fmt::format("--harmonic: found '{}', expected INPUT=AMPLITUDE@HERTZ, as road=0.01@1.5",
                  excerpt(text)));
}

HarmonicResponse harmonic_of(const Model& model, const std::vector<std::string>& outputs,
                             const HarmonicRequest& request) {
  const LinearModel linear = linear_model(model, {{request.input}, outputs});
  const Eigen::VectorXcd y =
      request.amplitude * FrequencyResponse(linear).at_frequency(request.frequency).col(0);
  HarmonicResponse h{request.input,
                     linear.inputs[0].unit,
                     request.amplitude,
                     request.frequency,
                     linear.outputs,
                     {},
                     {}};
  for (Eigen::Index k = 0; k < y.size(); ++k) {
    h.means.push_back(linear.output_values[k]);
    h.values.push_back(y[k]);
  }
  return h;
}

void add_curves(const LinearModel& linear, ResponseResult& r) {
  const FrequencyResponse response(linear);
  for (const LinearInput& input : linear.inputs)
    for (const Column& output : linear.outputs)
      r.curves.push_back({output, {input.name, input.unit}, {}});
  for (std::size_t n = 0; n < r.frequencies.size(); ++n) {
    tell_progress("frequencies", 1.0 * n / r.frequencies.size());
    const Eigen::MatrixXcd G = response.at_frequency(r.frequencies[n]);
    std::size_t k = 0;
    for (Eigen::Index j = 0; j < G.cols(); ++j)
      for (Eigen::Index i = 0; i < G.rows(); ++i) r.curves[k++].values.push_back(G(i, j));
  }
}

AnalysisReport report_unbalance(const Model& model, const ResponseOptions& o) {
  if (o.rotor.empty() || o.unbalance.empty())
    throw InputError(ErrorCode::incomplete,
                     o.rotor.empty()
                         ? "--unbalance needs --rotor JOINT=FROM:TO:STEP, the speeds [rad/s]"
                         : "--rotor needs --unbalance BODY=KG_M, at least one");
  if (!o.ports.inputs.empty() || !o.harmonic.empty() || !o.spectrum.empty() || !o.at.empty())
    throw InputError(ErrorCode::exclusive,
                     "--rotor goes through speeds under unbalance alone, expected none of "
                     "--inputs, --harmonic, --road-spectrum, --at with it");
  const SpeedRange range = speed_range("--rotor", o.rotor);
  UnbalanceOptions options{range.joint, range.from,      range.to,          range.step,
                           {},          o.ports.outputs, axis_named(o.axis)};
  for (const std::string& text : o.unbalance) options.unbalances.push_back(unbalance_of(text));
  const auto r = std::make_shared<UnbalanceResponse>(unbalance_response(model, options));
  return {.text = unbalance_text(model.name, options, *r),
          .json = unbalance_json(model.name, options, *r),
          .files = {[r] { return unbalance_csv(*r); },
                    [r, options, name = model.name] { return unbalance_svg(name, options, *r); }}};
}

AnalysisReport report_response(const Model& given, const ResponseOptions& o) {
  if (!o.rotor.empty() || !o.unbalance.empty()) return report_unbalance(given, o);
  if (!(o.to > o.from))
    throw InputError(
        ErrorCode::out_of_range,
        fmt::format("--to: found {:g} Hz, expected more than --from, {:g} Hz", o.to, o.from));
  const Model model = counted_at_operating_point(given, o.at).model;
  const auto r = std::make_shared<ResponseResult>();
  r->model = given.name;
  r->frequencies = frequencies_between(o.from, o.to, o.points);
  for (const std::string& text : o.harmonic)
    r->harmonics.push_back(harmonic_of(model, o.ports.outputs, harmonic_request(text)));
  if (!o.spectrum.empty()) {
    if (!(o.speed > 0.0))
      throw InputError(ErrorCode::incomplete,
                       "--road-spectrum needs --speed, a positive number [m/s]");
    r->loading = {roughness_of(o.spectrum), o.waviness, o.speed, o.from, o.to};
    r->road = road_response(model, o.ports.outputs, r->frequencies, r->loading);
  } else if (o.speed > 0.0) {
    throw InputError(ErrorCode::incomplete, "--speed is of --road-spectrum, which is not given");
  }
  // With a road or a harmonic input, curves are computed only for explicitly named inputs.
  const bool others = r->road || !r->harmonics.empty();
  const LinearModel linear = linear_model(model, {o.ports.inputs, o.ports.outputs});
  r->time = linear.time;
  r->notes = linear.system.notes;
  r->stiffened = linear.system.stiffened;
  r->stiffening = linear.system.stiffening;
  if (!others || !o.ports.inputs.empty()) add_curves(linear, *r);
  return {.text = response_text(*r),
          .json = response_json(*r),
          .files = {[r] { return response_csv(*r); }, [r] { return response_svg(*r); }}};
}

}  // namespace

Analysis response_analysis() {
  const auto o = std::make_shared<ResponseOptions>();
  constexpr double largest = 1e9;
  return {.name = "response",
          .help =
              "Frequency response of outputs to inputs, also to random roads (Hz, SI units); "
              "response of rotors to unbalance",
          .options =
              {word_list(
                   "--inputs", o->ports.inputs, {},
                   "Inputs of the model, 'motion of JOINT', 'road', 'road at TYRE'; default: all"),
               word_list("--outputs", o->ports.outputs, {}, "Outputs of the model; default: all"),
               operating_point_option(o->at),
               number_option("--from", o->from, 1e-6, largest, "HERTZ", "Lowest frequency [Hz]"),
               number_option("--to", o->to, 1e-6, largest, "HERTZ", "Highest frequency [Hz]"),
               whole_option("--points", o->points, 1, 100'000,
                            "Frequencies, evenly on a logarithmic axis"),
               repeated_option("--harmonic", o->harmonic, "INPUT=AMPLITUDE@HERTZ",
                               "Steady motion where an input swings; may be repeated"),
               text_option("--road-spectrum", o->spectrum, "CLASS",
                           "Spectra and rms on a random road (ISO 8608) of class A to H, or of "
                           "this roughness at 0.1 cycles/m [m3]"),
               number_option("--speed", o->speed, 0.0, 1e4, "M/S", "Along the road [m/s]"),
               number_option("--waviness", o->waviness, 0.0, 10.0, "W",
                             "Exponent of the road's spectrum"),
               text_option("--rotor", o->rotor, "JOINT=FROM:TO:STEP",
                           "Response to unbalance over the speed of a rotor [rad/s] instead"),
               repeated_option("--unbalance", o->unbalance, "BODY[:NODE]=KG_M[@DEG]",
                               "Unbalance on the axis of the rotor [kg m]; may be repeated"),
               word_option("--axis", o->axis, {"x", "y", "z"}, axis_help)},
          .json_help = "JSON on standard output",
          .files = {{"--csv", "Write magnitude, phase, real and imaginary part, and densities"},
                    {"--svg", "Write Bode plots and densities"}},
          .footer =
              "Inputs are meant by their values: height of a road, angle of a prescribed motion.\n"
              "Exit codes: 0 done, 1 the start cannot be found or the response has no bound, 2 bad "
              "input.",
          .run = [o](const Model& model) { return report_response(model, *o); }};
}

}  // namespace floatframe
