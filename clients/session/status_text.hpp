// A machine's status and a job's progress as text for a person, within 80 columns. Pure.
#pragma once

#include <string>

#include "idl/proto/report.pb.h"

namespace lockstep {

/// A block of lines: the machine, a table of the axes, the faults with what to do.
std::string status_text(const proto::StatusReport& status);

/// "received 4 ms ago, a standby is ready": the age of the coordinator's state, and whether a standby is received.
std::string age_text(const proto::StatusReport& status);
/// "anna on bench"; empty if there is no writer.
std::string writer_text(const proto::StatusReport& status);
/// "feed 60 %, rapid 100 %"; empty if all is as programmed.
std::string overrides_text(const proto::StatusReport& status);
/// "spindle forward 12000 rpm, flood, tool 3, outputs 0 2"; empty if the status has no devices.
std::string devices_text(const proto::StatusReport& status);
/// "change to tool 2: 6 mm end mill", "waits for an input: until clamp is closed (6.2 s left)"
std::string paused_text(const proto::PauseReport& pause);
/// One line: "[######              ]  30 %  line 12  4.2 s left".
std::string progress_bar(const proto::StatusReport& status);
/// One line without the bar: "Running: 30 %, line 12, 4.2 s left".
std::string progress_text(const proto::StatusReport& status);
/// "not homed: X, Y; home: lockstep home"; empty if every axis is homed.
std::string unhomed_text(const proto::StatusReport& status);
/// "X 12.000  Y 3.250", of final positions.
std::string places_text(const proto::RunReport& report);

}  // namespace lockstep
