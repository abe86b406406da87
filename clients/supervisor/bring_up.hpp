// Starts a machine's processes on this host, and waits until they are ready.
#pragma once

#include <expected>
#include <optional>
#include <string>

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

/// Routes multicast and claims the state directory, with a copy of the configuration in it; warns if the record
/// or positions cannot be kept. Error: the machine is up already, or a program or the directory is missing.
std::expected<OwnParts, Failure> prepare(const ChosenMachine& machine, const Layout& layout,
                                         const StateDirectory& state, Output& output);

/// Supervises in this process until SIGTERM or SIGINT.
void supervise(const StateDirectory& state, const std::vector<ServiceLine>& lines);

/// Supervises in a process of its own that outlives this one. Call it before the first thread starts. Returns the
/// supervisor. Error: no more processes.
std::expected<ProcessRecord, Failure> supervise_in_background(const StateDirectory& state,
                                                              const std::vector<ServiceLine>& lines);

/// Idle, or in Fault, with all axes present.
bool is_whole(const Session& session);

/// Whether this host runs every part of the machine.
bool is_alone(const MachineConfig& machine, const Placement& placed);

/// Waits until this host's parts are on the network; where it runs all of them, until the machine is whole. Parts
/// of other hosts may start at any time. Error: a part is run by others, was given up, or is missing, with
/// the end of its log.
std::expected<Session, Failure> wait_until_up(const ChosenMachine& machine, const OwnParts& parts,
                                              const StateDirectory& state, const ProcessRecord& supervisor);

/// Waits for the parts on other hosts. Returns whether the machine is whole.
bool await_others(Session& session, std::chrono::nanoseconds patience);

}  // namespace lockstep
