// Starts a machine's processes on this host, and waits until they are ready.
#pragma once

#include <expected>

#include "clients/session/session.hpp"
#include "clients/supervisor/machine_choice.hpp"
#include "clients/supervisor/service_lines.hpp"
#include "clients/supervisor/state_directory.hpp"
#include "clients/text/output.hpp"
#include "services/documents/placement.hpp"

namespace lockstep {

/// The parts of a machine that this host runs.
struct OwnParts {
    Placement placed;
    std::vector<ServiceLine> lines;
};

/// Routes multicast, claims the state directory and copies the configuration into it. Warns if the record or positions
/// cannot be kept. Fails if the machine is up already, or a program or the directory is missing.
std::expected<OwnParts, Failure> prepare(const ChosenMachine& machine, const Layout& layout,
                                         const StateDirectory& state, Output& output);

/// Supervises in this process until SIGTERM or SIGINT.
void supervise(const StateDirectory& state, const std::vector<ServiceLine>& lines);

/// Supervises in a separate process that outlives this one, and returns that process. Call it before the first thread
/// starts. Fails if no process can be started.
std::expected<ProcessRecord, Failure> supervise_in_background(const StateDirectory& state,
                                                              const std::vector<ServiceLine>& lines);

/// True if the machine is Idle or in Fault, with all axes present.
bool is_whole(const Session& session);

/// True if this host runs every part of the machine.
bool is_alone(const MachineSetup& machine, const Placement& placed);

/// Waits until this host's parts are on the network. If this host runs all parts, waits until the machine is whole.
/// Parts of other hosts may start at any time. Fails if a part runs elsewhere, was given up, or is missing; the error
/// has the end of its log.
std::expected<Session, Failure> wait_until_up(const ChosenMachine& machine, const OwnParts& parts,
                                              const StateDirectory& state, const ProcessRecord& supervisor);

/// Waits for the parts on other hosts. Returns true if the machine is whole.
bool await_others(Session& session, std::chrono::nanoseconds patience);

}  // namespace lockstep
