#pragma once
// Results as comma-separated values (RFC 4180): one header line `time [s],chassis.z [m],...`, then
// one line per sample. SI units, angles in radians, 17 significant digits, so that every number
// reads back to the same bits.
#include <string>

#include "floatframe/simulation/result_table.hpp"

namespace floatframe {

std::string results_csv(const ResultTable& table);

}  // namespace floatframe
