// Checks that a log is exactly what its machine and its programs give: every step, at its tick.
//
// There are two levels. On the first, every step in the log must be the one that the tick-exact engine makes of the
// runs in the log, and every run's steps must be in the log. On the second, the runs of every job must equal, bit for
// bit, the frames that planning its program again gives, from its start position through every hold, stop and
// resumption. So if a run of several processes and a simulation in one process both verify, they have the same tick for
// every step, relative to the start of motion. Homing depends on the positions of the switches, which the log does not
// contain, so it is checked only on the first level.
//
// The events of programs (core: ProgramEvent) must be on record once each, in order. Those in motion must be at the
// exact tick that planning gives, the others where the axes rest.
//
// A log may end badly. Steps that a killed process left without the record of their run are compared with every course
// that the plan allows: further frames, and the tail of the last one. A note names the course and the steps that are
// not on record. A job without an end is compared with its plan as far as it ran, if the axes have come to rest by
// then.
//
// A log may begin late and end early, at any message. Steps are compared from the first message of steps on, frames
// from the first job that begins in the log. If the log lacks data for a result, the result is unknown.
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

/// Fails if the file is not a log, contains nothing of Lockstep to compare, or has a document that cannot be decoded.
/// `progress` is called with 0 ... 1 now and then.
std::expected<Findings, std::string> verify_log(const std::filesystem::path& log,
                                                const std::function<void(double)>& progress = {});

proto::VerifyReport to_report(const Findings& findings);

void fill(const Difference& difference, proto::Difference& out);

/// For a terminal: one paragraph, ends with a newline.
std::string to_text(const Findings& findings);

}  // namespace lockstep::verification
