// Replays a recorded run on simulated devices: checks that the recorded frames make the recorded steps.
//
// The frames on record are written into a device's registers by the driver and executed by the device alone; each of
// its steps must be the recorded one, at its tick. Nothing is planned: `lockstep verify` does that. So this
// distinguishes an error of the device from an error of the plan.
#pragma once

#include <expected>
#include <filesystem>
#include <functional>
#include <string>

#include "clients/verification/findings.hpp"
#include "idl/proto/report.pb.h"
#include "services/record/record_sink.hpp"

namespace lockstep::replay {

using verification::Findings;

/// `made`: the destination of the replay's own log; null: none. Error: the file is not a log, or contains no run.
/// `progress` is called with 0 ... 1 now and then.
std::expected<Findings, std::string> replay_log(const std::filesystem::path& log, RecordSink* made,
                                                const std::function<void(double)>& progress = {});

/// `log`: the one written, if any.
proto::ReplayReport to_report(const Findings& findings, const std::string& log);

/// For a terminal: one paragraph, ends with a newline.
std::string to_text(const Findings& findings);

}  // namespace lockstep::replay
