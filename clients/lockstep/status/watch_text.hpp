// The machine's status as text for a terminal of 80 columns: the text is a function of the status alone.
#pragma once

#include <string>

#include "core/machine.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The scale of the slack of setpoints.
struct SlackScale {
    double ahead_ms = 0;     // so long before its start the coordinator sends a frame
    double deadline_ms = 0;  // so long before its start an axis must hold it, or it is not run
};
SlackScale slack_scale(const ProtocolTiming& timing);

enum class Ink { Plain, Colour };

/// Lines of at most 80 columns: machine and job, a row for each axis, alarms with what to do.
///
/// The bar of a row is the least slack of the second before, filled from the left: a full bar is a frame that came as
/// early as it was sent, the mark | is the deadline.
std::string watch_text(const proto::StatusReport& status, const SlackScale& scale, Ink ink);

/// One line, without a terminal.
std::string watch_line(const proto::StatusReport& status, const SlackScale& scale);

}  // namespace lockstep
