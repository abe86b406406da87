// How a probing move ended: the coordinator's result, and where the axes came to rest.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "clients/session/session.hpp"
#include "core/gcode/gcode.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

/// The error of a result that is not of this machine.
using TouchOrError = std::expected<ProbeTouch, std::string>;

/// The result of the job that probed, and where every axis rests, as reported after `since`; nullopt until all is
/// received.
std::optional<TouchOrError> received_touch(const Session& session, std::uint64_t job, std::chrono::nanoseconds since);
/// Waits until the result of the job that probed and the rest of every axis are received. Fails if they are not, or are
/// not of this machine.
std::expected<ProbeTouch, Failure> touch_of(Session& session, std::uint64_t job);

proto::ProbeReport probe_report(const MachineConfig& machine, const ProbeTouch& touch);
/// "input probe touched at X 10.0000  Z -3.2150; the axes rest 0.0210 mm behind it", or where the move ended without a
/// touch.
std::string text_of(const proto::ProbeReport& probe);

}  // namespace lockstep
