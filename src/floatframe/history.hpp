#pragma once
// What is left of a run: the table of its outputs, the table as CSV, the file of its states and new
// channels from these, all files of a run kept in memory, its bodies at an instant:
// Floatframe::tools but for the table.
#include "floatframe/export/run_scene.hpp"
#include "floatframe/history/new_channels.hpp"
#include "floatframe/history/state_history.hpp"
#include "floatframe/page/kept_run.hpp"
#include "floatframe/results/results_csv.hpp"
#include "floatframe/results/summary_json.hpp"
#include "floatframe/run/result_table.hpp"
