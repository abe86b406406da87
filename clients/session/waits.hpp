// Functions that wait for something from a machine: its states, a reply to a command, values that are on its disk.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <optional>

#include "clients/session/session.hpp"
#include "core/program.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {

inline constexpr std::chrono::seconds kReachPatience{3};
inline constexpr std::chrono::seconds kDiskPatience{15};        // a disk may hang for seconds
inline constexpr std::chrono::milliseconds kGivePatience{300};  // for the answer to a lease that is given back

/// The failure of a client that receives no coordinator. It names the motors that are received, and the remedy.
Failure silence(const Session& session);

/// Waits until a coordinator publishes states and is matched with this client.
std::expected<void, Failure> reach(Session& session, std::chrono::nanoseconds patience = kReachPatience);
/// Waits until every axis is received. The error names an axis that is not.
std::expected<void, Failure> reach_axes(Session& session);
/// Waits for the axes that the coordinator receives, and briefly for the others. Axes that are still missing count as
/// absent.
void await_axes(Session& session);
/// Waits for the live figures of every received axis; axes publish them ten times a second.
void await_healths(Session& session, std::chrono::nanoseconds patience);

/// Follows the command until its answer comes. Fails if none comes in time, or none soon after a signal to `stop`. An
/// emergency stop also goes to the axes, which stop without the coordinator.
std::expected<Reply, Failure> send_command(Session& session, const Command& command, const StopSignal* stop = nullptr,
                                           std::chrono::nanoseconds patience = CommandTracker::kPatience);

/// See LeaseKeeper::use(). Sends what this needs at once.
void use_lease(Session& session, const LeaseUse& use);
/// Requests the lease and waits for the reply, which refuses it if another writer has it. `takes_over` takes it from
/// that writer. Fails like send_command().
std::expected<Reply, Failure> take_lease(Session& session, bool takes_over = false, const StopSignal* stop = nullptr);
/// Gives the lease back and waits at most `patience` for the coordinator's answer. Sends nothing without the lease.
void give_lease(Session& session, std::chrono::nanoseconds patience = {});

/// Sends a whole program, with the machine's values that it depends on and leaves. Returns its id for a command. Fails
/// if it is refused, if no reply comes, or at a signal to `stop`.
std::expected<std::uint64_t, Failure> send_program(Session& session, const Program& program,
                                                   const StopSignal* stop = nullptr,
                                                   const std::optional<gcode::ProgramValues>& values = {});
/// Begins a program that is sent while it is being made and while it runs. Returns its id for a command, as soon as the
/// coordinator has its first blocks. Fails like send_program().
std::expected<std::uint64_t, Failure> stream_program(Session& session, const ProgramHead& head,
                                                     const std::optional<gcode::ProgramValues>& values,
                                                     ProgramUpload::Feed feed, const StopSignal* stop = nullptr);

/// The machine's offsets and tools. Waits until they are received.
std::expected<RevisedValues, Failure> await_values(Session& session);
/// Waits until the coordinator reports that this revision, or a later one, is on its disk. Fails if it does not report
/// that in time.
std::expected<void, Failure> await_kept(Session& session, std::uint64_t revision);

}  // namespace lockstep
