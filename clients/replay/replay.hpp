// Replays a recorded run on simulated devices: checks that the recorded frames make the recorded steps.
//
// The driver writes the recorded frames into a device's registers, and the device alone executes them. Each of its
// steps must equal the recorded one, at the same tick. Nothing is planned here; `lockstep verify` does that. So a
// difference here is an error of the device, not of the plan.
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

/// `made` receives the replay's own log; it may be null. `progress` is called with 0 ... 1 now and then. Fails if the
/// file is not a log or contains no run.
std::expected<Findings, std::string> replay_log(const std::filesystem::path& log, RecordSink* made,
                                                const std::function<void(double)>& progress = {});

/// `log`: path of the written log, empty if none.
proto::ReplayReport to_report(const Findings& findings, const std::string& log);

/// For a terminal: one paragraph, ends with a newline.
std::string to_text(const Findings& findings);

}  // namespace lockstep::replay
