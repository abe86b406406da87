// Reads a program that a client has sent: checks it as a whole, and makes it ready to run.
#pragma once

#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "clients/session/session.hpp"
#include "clients/web/http/message.hpp"
#include "clients/web/program/path_points.hpp"
#include "clients/web/request/problem.hpp"
#include "clients/web/state/snapshot.hpp"

namespace lockstep::web {

/// A program that was checked.
struct LoadedProgram {
    std::shared_ptr<const ProgramFacts> facts;
    SharedText text;
    std::shared_ptr<const std::vector<PathPoint>> path;
};

/// Where a program begins, and with which offsets and tools.
struct ProgramStart {
    std::vector<double> place_mm;  // one for each axis
    RevisedValues values;
};

/// For a check: an axis that is not received or not homed counts as parked.
ProgramStart checked_start(const Snapshot& snapshot, const MachineConfig& machine);
/// To run it. Error: what the machine does instead, or an axis or the offsets are not received.
std::expected<ProgramStart, Problem> real_start(const Snapshot& snapshot, const MachineConfig& machine);

/// `id`: the new program's. Error: 415 where it is no text; 422 with the errors by line and column.
std::expected<LoadedProgram, Problem> load_program(std::string text, const std::string& name, std::uint64_t id,
                                                   const MachineConfig& machine, const ProgramStart& start);

/// A program and what a session sends of it.
struct ReadyProgram {
    ProgramHead head;
    gcode::ProgramValues values;
    Session::Feed feed;
    std::shared_ptr<const ProgramFacts> facts;
};

/// A long program is read again while it runs; its first part is read here. Error: 422, as for load_program.
std::expected<ReadyProgram, Problem> ready_program(const LoadedProgram& program, const MachineConfig& machine,
                                                   const ProgramStart& start);

}  // namespace lockstep::web
