#pragma once
// Output of a paced run: text for people, JSON for programs.
#include <string>

#include "floatframe/model/model.hpp"
#include "floatframe/realtime/realtime.hpp"
#include "floatframe/realtime/udp_port.hpp"

namespace floatframe {

/// Names, units, limits and places of all values in the packets.
std::string layout_text(const Model& model);
std::string layout_json(const Model& model);

/// `options`: those of the run; its log is finished. `port` may be null.
std::string realtime_text(const RealTimeReport& report, const RealTimeOptions& options,
                          const Model& model, const UdpPort* port);
std::string realtime_json(const RealTimeReport& report, const RealTimeOptions& options,
                          const Model& model, const UdpPort* port);

}  // namespace floatframe
