#pragma once
// What is left of a run: the table of its outputs, the table as CSV, the file of its states and new
// channels from these, and all files of a run that was kept in memory.
#include "floatframe/history/new_channels.hpp"
#include "floatframe/history/state_history.hpp"
#include "floatframe/report/kept_run.hpp"
#include "floatframe/report/results_csv.hpp"
#include "floatframe/report/summary_json.hpp"
#include "floatframe/simulation/result_table.hpp"
