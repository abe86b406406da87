// Writes the machine's status as text for a terminal of 80 columns. The text depends only on the arguments.
#pragma once

#include <string>

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The scale of the slack of setpoints.
struct SlackScale {
    double ahead_ms = 0;     // the coordinator sends a frame this long before its start
    double deadline_ms = 0;  // an axis must hold a frame this long before its start, else the frame is not run
};
SlackScale slack_scale(const ProtocolTiming& timing);

enum class Ink { Plain, Colour };

/// Lines of at most 80 columns: machine and job, a row for each axis, alarms with their remedies.
///
/// The bar of a row shows the least slack of the last second, filled from the left. A full bar means that frames arrive
/// as soon as they are sent. The mark | is the deadline.
std::string watch_text(const proto::StatusReport& status, const SlackScale& scale, Ink ink);

/// The status in one line, for output without a terminal.
std::string watch_line(const proto::StatusReport& status, const SlackScale& scale);

}  // namespace lockstep
