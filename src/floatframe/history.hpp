#pragma once
// Sampled outputs: the table of a run, and the table as CSV.
#include "floatframe/report/results_csv.hpp"
#include "floatframe/simulation/result_table.hpp"
