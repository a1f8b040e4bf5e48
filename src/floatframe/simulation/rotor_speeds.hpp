#pragma once
// The speeds of a rotor that an analysis goes through.
#include <string>
#include <vector>

namespace floatframe {

/// from, from + step, ..., to [rad/s]. Throws InputError, which names the joint, unless they ascend
/// and are not too many or too fast.
std::vector<double> rotor_speeds(const std::string& joint, double from, double to, double step);

}  // namespace floatframe
