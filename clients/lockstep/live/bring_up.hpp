// Starts a machine's processes on this host, and waits until it can be used.
#pragma once

#include <expected>
#include <optional>
#include <string>

#include "clients/lockstep/live/machine_choice.hpp"
#include "clients/lockstep/live/service_lines.hpp"
#include "clients/lockstep/live/session.hpp"
#include "clients/lockstep/live/state_directory.hpp"
#include "clients/lockstep/live/voice.hpp"

namespace lockstep {

/// Routes multicast and claims the state directory, with a copy of the configuration in it; warns where the record
/// cannot be published. Error: the machine is up already, or a program or the directory is missing.
std::expected<std::vector<ServiceLine>, Failure> prepare(const ChosenMachine& machine, const Layout& layout,
                                                         const StateDirectory& state, Voice& voice);

/// Supervises in this process until SIGTERM or SIGINT.
void supervise(const StateDirectory& state, const std::vector<ServiceLine>& lines);

/// Supervises in a process of its own that outlives this one. Call it before the first thread starts. Returns the
/// supervisor. Error: no more processes.
std::expected<ProcessRecord, Failure> supervise_in_background(const StateDirectory& state,
                                                              const std::vector<ServiceLine>& lines);

/// Waits until the machine is Idle, or in Fault, with all axes heard. `since`: CLOCK_MONOTONIC before the start; who
/// runs for longer was not started here. Error: who that is, or who is missing, with the end of its log.
std::expected<Session, Failure> wait_until_up(const ChosenMachine& machine, const StateDirectory& state,
                                              std::chrono::nanoseconds since);

}  // namespace lockstep
