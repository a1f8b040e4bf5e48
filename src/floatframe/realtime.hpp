#pragma once
// A model in step with the wall clock: options, ports, a log, the report. Of Floatframe::tools.
#include "floatframe/realtime/realtime.hpp"
#include "floatframe/realtime/realtime_options.hpp"
#include "floatframe/realtime/signal_log.hpp"
#include "floatframe/realtime/signal_port.hpp"
