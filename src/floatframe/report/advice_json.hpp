#pragma once
// The advice on modes as JSON.
#include <string>

#include "floatframe/simulation/mode_advice.hpp"

namespace floatframe {

/// Infinite frequencies (modes without mass) are null.
std::string advice_json(const std::string& model, double step, const ModeAdviceReport& report,
                        const AdviceOptions& options);

}  // namespace floatframe
