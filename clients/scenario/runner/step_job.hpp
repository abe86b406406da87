// The job of a step: homing, a move, or a program. A program with probing moves is several jobs of the machine, because
// the lines behind such a move depend on its touch.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <vector>

#include "clients/scenario/model/scenario.hpp"
#include "clients/scenario/runner/run_notes.hpp"
#include "clients/session/program_stream.hpp"
#include "clients/session/session.hpp"

namespace lockstep::scenario {

class StepJob {
public:
    /// Reads the program of the step from where the machine stands. `step` is a home, run or move. Fails if the machine
    /// is not received, or if the program has an error from there.
    static std::expected<StepJob, Failure> prepare(const Scenario& scenario, const Asked::Step& step, Session& session);

    /// Begins the job, or its next part. Fails if the coordinator does not answer.
    std::expected<Reply, Failure> begin();
    /// Call it when this job of the machine is done. Returns whether another part follows. Notes the touch.
    std::expected<bool, Failure> read_on(std::uint64_t job, RunNotes& notes);

private:
    StepJob(Session& session, const Command& command) : session_(session), command_(command) {}
    std::expected<void, Failure> read_run(const Scenario& scenario, const Asked::Run& run);
    std::expected<void, Failure> read_move(const Scenario& scenario, const Asked::Move& move);
    std::expected<std::uint64_t, Failure> send();

    Session& session_;
    Command command_;
    std::optional<ProgramStream> run_;
    std::optional<Program> move_;
};

}  // namespace lockstep::scenario
