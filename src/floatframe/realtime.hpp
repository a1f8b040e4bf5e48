#pragma once
// A model in step with the wall clock: options, ports for inputs and outputs, a log, the report.
#include "floatframe/realtime/realtime.hpp"
#include "floatframe/realtime/realtime_options.hpp"
#include "floatframe/realtime/signal_log.hpp"
#include "floatframe/realtime/signal_port.hpp"
