#pragma once
// All of Floatframe that a program uses. Eigen is the only other library that it sees.
//
//   namespace ff = floatframe;
//   const ff::Model model = ff::load_model("vehicle.yaml", {{"speed", "10"}});
//   ff::Simulation sim(model, {.step = 1e-3});
//   while (sim.time() < 8.0)
//     if (const ff::StepReport r = sim.step(); !r) throw std::runtime_error(sim.failure());
//   const double z = sim.output("chassis.z");
#include "floatframe/analysis.hpp"
#include "floatframe/body.hpp"
#include "floatframe/errors.hpp"
#include "floatframe/fmu.hpp"
#include "floatframe/history.hpp"
#include "floatframe/model.hpp"
#include "floatframe/part.hpp"
#include "floatframe/realtime.hpp"
#include "floatframe/simulation.hpp"
#include "floatframe/sweep.hpp"
#include "floatframe/types.hpp"
#include "floatframe/version.hpp"
