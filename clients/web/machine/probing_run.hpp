// A program that probes, while its parts run: behind each touch it makes the next part ready.
#pragma once

#include <chrono>
#include <optional>

#include "clients/session/session.hpp"
#include "clients/web/program/program_reading.hpp"

namespace lockstep::web {

/// 409: a program was not run to its end.
Problem ended_early(const std::string& why);

class ProbingRun {
public:
    /// `job` runs the program's present part.
    ProbingRun(ReadyProgram program, std::uint64_t job) : program_(std::move(program)), job_(job) {}

    enum class State : std::uint8_t {
        Runs,   // the job has not ended, or the touch and the axes' rest are not known yet
        Ready,  // next() is the part behind the touch
        Over,   // nothing more is to run
    };
    /// Call it in each loop until it is not Runs. Reads the next part's first lines.
    State poll(const Session& session);
    const ReadyProgram& next() const { return program_; }

    /// Of the present part, when it is not Runs.
    const std::optional<ProbeTouch>& touch() const { return touch_; }
    /// Nothing more is to run.
    bool is_over() const { return is_over_; }
    /// Of a program that is over: why it was not run to its end.
    const std::optional<Problem>& problem() const { return problem_; }

private:
    bool awaits_touch() const;
    State end(std::optional<Problem> problem);
    State read_on(const Session& session);

    ReadyProgram program_;
    std::uint64_t job_;
    std::optional<ProbeTouch> touch_;
    bool is_over_ = false;
    std::optional<Problem> problem_;
    std::optional<std::chrono::nanoseconds> ended_;
};

}  // namespace lockstep::web
