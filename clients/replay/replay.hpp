// A recorded run, given to simulated devices again: whether what each device was given makes the steps on record.
//
// The frames on record are written into a device's registers by the driver and executed by the device alone; each of
// its steps must be the recorded one, at its tick. Nothing is planned: `lockstep verify` does that. So this tells a
// device that does not as it is told from a plan that is not as it should be.
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

/// `made`: where the replay's own log goes; null: nowhere. Error: the file is no log, or no run is in it. `progress`
/// hears 0 ... 1 now and then.
std::expected<Findings, std::string> replay_log(const std::filesystem::path& log, RecordSink* made,
                                                const std::function<void(double)>& progress = {});

/// `log`: the one written, if any.
proto::ReplayReport to_report(const Findings& findings, const std::string& log);

/// For a terminal: one paragraph, ends with a newline.
std::string to_text(const Findings& findings);

}  // namespace lockstep::replay
