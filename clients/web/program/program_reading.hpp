// Reads a program that a client has sent: checks it as a whole, and makes it ready to run.
#pragma once

#include <expected>
#include <memory>
#include <string>
#include <vector>

#include "clients/session/program_stream.hpp"
#include "clients/session/upload/program_upload.hpp"
#include "clients/web/http/message.hpp"
#include "clients/web/measuring/measurement.hpp"
#include "clients/web/program/path_points.hpp"
#include "clients/web/request/problem.hpp"
#include "clients/web/state/snapshot.hpp"
#include "services/setup/machine_setup.hpp"

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

/// The start for a check. An axis that is not received or not homed counts as parked.
ProgramStart checked_start(const Snapshot& snapshot, const MachineSetup& machine);
/// The start for a run. Fails if the machine or an axis is not ready, or an axis or the offsets are not received.
std::expected<ProgramStart, Problem> real_start(const Snapshot& snapshot, const MachineSetup& machine);

/// `id`: of the new program. Fails with 415 if it is not text, and with 422 and its errors by line and column.
std::expected<LoadedProgram, Problem> load_program(std::string text, const std::string& name, std::uint64_t id,
                                                   const MachineSetup& machine, const ProgramStart& start);

/// A program, and the feed by which a session sends it.
struct ReadyProgram {
    ProgramHead head;
    gcode::ProgramValues values;
    ProgramUpload::Feed feed;
    std::shared_ptr<const ProgramFacts> facts;
    std::shared_ptr<ProgramStream> stream = {};        // that `feed` sends; null if it was read as a whole
    std::shared_ptr<const MeasurePlan> measures = {};  // null unless it measures with a probe
};

/// Reads the first part here of a program that is long or probes; the rest is read while it runs. Fails with 422 like
/// load_program().
std::expected<ReadyProgram, Problem> ready_program(const LoadedProgram& program, const MachineSetup& machine,
                                                   const ProgramStart& start);

/// Reads the stream's first part. Fails with 422 like load_program().
std::expected<ReadyProgram, Problem> ready_stream(std::shared_ptr<ProgramStream> stream,
                                                  std::shared_ptr<const ProgramFacts> facts,
                                                  std::shared_ptr<const MeasurePlan> measures = {});

/// Passes the blocks to a session's sender as it has room for them.
ProgramUpload::Feed feed_of(std::vector<Block>&& blocks);
/// 422 with the errors.
Problem wrong_program(const Diagnostics& errors);

}  // namespace lockstep::web
