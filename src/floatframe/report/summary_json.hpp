#pragma once
// Summaries for other programs: JSON (RFC 8259) with SI units; the unit is in the key where it is
// not obvious. The words are those of the command line. A number that is not finite becomes null.
#include <string>

#include "floatframe/simulation/results.hpp"

namespace floatframe {

/// Of a run: what was asked, what it cost, how well the constraints were met, how it ended.
std::string summary_json(const RunSummary& summary);

/// Of a check: numbers of bodies, joints, coordinates and constraints in both formulations.
std::string counts_json(const ModelCounts& counts);

/// Of a static equilibrium: forces [N], torques [N m], positions [m], angles [rad]; `warnings`:
/// where it leaves the range of the method.
std::string statics_json(const std::string& model, const StaticsResult& statics,
                         const std::vector<RangeWarning>& warnings = {});

}  // namespace floatframe
