#pragma once
// Results of manoeuvres as text and as JSON; angles in degrees, gradients per m/s2.
#include <string>

#include "floatframe/vehicle/lane_change.hpp"
#include "floatframe/vehicle/manoeuvres.hpp"
#include "floatframe/vehicle/straight_stop.hpp"

namespace floatframe {

struct ManoeuvreReport {
  std::string text, json;
};

ManoeuvreReport manoeuvre_report(const std::string& model, const StepSteerResult& result);
ManoeuvreReport manoeuvre_report(const std::string& model, const SteadyCircleResult& result);
ManoeuvreReport manoeuvre_report(const std::string& model, const LaneChangeResult& result);
ManoeuvreReport manoeuvre_report(const std::string& model, const StraightStopResult& result);

}  // namespace floatframe
