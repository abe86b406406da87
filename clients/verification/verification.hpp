// Whether a log is exactly what its machine and its programs must give: every step, at its tick.
//
// Two levels. Every step in the log must be the one that the tick-exact engine makes of the runs in the log, and every
// run's steps must be there. And the runs of every job must be, bit for bit, the frames that planning its program
// again gives, from where it started, through every hold, stop and resumption. So a run across processes and a
// simulation in one process that both verify have the same ticks for every step, relative to the start of motion.
// Homing depends on where the switches are, which the log does not know: it is held to the first level alone.
//
// A log may end badly. What a process that was killed left without the record of its run is held to every course that
// the plan allows it: its frames to come, and the tail of each; a note says which it was, and what is not on record. A
// job without an end is held to its plan as far as it was run, if the axes have come to rest by then.
//
// A log may begin late and end early, at any message. What it has is compared: steps from the first message of steps
// on, frames from the first job on that begins in it. Where it lacks what an answer needs, the answer is unknown.
//
// The log is read once, in memory that depends on the programs and not on the log's length.
#pragma once

#include <expected>
#include <filesystem>
#include <functional>
#include <string>

#include "clients/verification/findings.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep::verification {

/// Error: the file is no log, holds nothing of Lockstep's that could be compared, or a document in it cannot be
/// understood. `progress` hears 0 ... 1 now and then.
std::expected<Findings, std::string> verify_log(const std::filesystem::path& log,
                                                const std::function<void(double)>& progress = {});

proto::VerifyReport to_report(const Findings& findings);

void fill(const Difference& difference, proto::Difference& out);

/// For a terminal: one paragraph, ends with a newline.
std::string to_text(const Findings& findings);

}  // namespace lockstep::verification
