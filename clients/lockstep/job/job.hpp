// Runs a job from its command to its end, for home, move and run.
#pragma once

#include <expected>
#include <functional>
#include <optional>
#include <string>

#include "clients/session/program_stream.hpp"
#include "clients/session/session.hpp"
#include "clients/text/output.hpp"
#include "core/program.hpp"
#include "idl/proto/report.pb.h"

namespace lockstep {

struct Job {
    CommandKind command = CommandKind::Run;
    std::string kind;                            // as in the reports: "home", "move", "run", "own-move"
    std::string name;                            // of the program
    AxisSet axes;                                // home: the axes; empty for all
    std::optional<Program> program;              // move, run, own move
    std::optional<gcode::ProgramValues> values;  // run: the machine's values that it reads and changes
    ProgramStream* stream = nullptr;             // run: a program read while it runs, instead of `program`; each of
                                                 // its parts is a job
    std::optional<Ticks> ticks = {};             // own move: its duration; nullopt: as fast as allowed
    std::optional<double> planned_s;
    bool probes = false;  // `program` ends with a probing move
    bool detach = false;  // return when the job has begun
    bool take = false;    // take the lease even from another writer
    /// run: adds the result of a program that was run to its end to the report, and returns it as text.
    std::function<std::expected<std::string, Failure>(proto::RunReport& report)> conclude = {};
};

/// Begins the job, shows its progress, waits for its end and reports. SIGINT and SIGTERM stop the machine on its path;
/// SIGHUP (a closed terminal) holds it. The call then returns within about 15 s, even if the machine does not react.
ExitCode run_job(Session& session, const Job& job, Output& output);

}  // namespace lockstep
