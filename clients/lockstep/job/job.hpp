// Runs a job from its command to its end: common to home, move and run.
#pragma once

#include <optional>
#include <string>

#include "clients/session/program_stream.hpp"
#include "clients/session/session.hpp"
#include "clients/text/output.hpp"
#include "core/program.hpp"

namespace lockstep {

struct Job {
    CommandKind command = CommandKind::Run;
    std::string kind;                                 // as in the reports: "home", "move", "run", "own-move"
    std::string name;                                 // of the program
    AxisSet axes = 0;                                 // home: which; none: all
    std::optional<Program> program = {};              // move, run, own move
    std::optional<gcode::ProgramValues> values = {};  // run: the machine's, that it depends on and leaves
    ProgramStream* stream = nullptr;                  // run: a program that is read while it runs, instead of `program`
    Ticks ticks = {};                                 // own move: how long it lasts; 0: as fast as allowed
    std::optional<double> planned_s = {};
    bool detach = false;  // ends when the job has begun
    bool take = false;    // the lease from another writer, too
};

/// Begins the job, shows its progress, waits for its end, reports. SIGINT and SIGTERM first stop the machine on its
/// path; SIGHUP, a closed terminal, holds it. Both end this call within some 15 s, whatever the machine does.
ExitCode run_job(Session& session, const Job& job, Output& output);

}  // namespace lockstep
