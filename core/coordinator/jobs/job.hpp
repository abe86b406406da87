// A job, and what is reported of the last one.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "core/coordinator/program/known_program.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

struct MachineJob {
    std::uint64_t number = 0;
    JobKind kind = JobKind::Run;
    std::optional<std::uint64_t> program_id;      // Command::program, if another coordinator can continue the job
    std::shared_ptr<const KnownProgram> program;  // null for homing and jogs
    std::optional<Identity> client;               // that attends to the job: began it, or resumed it after its loss
};

/// The count of the machine's jobs, begun by any coordinator, and how the last one ended.
class JobCount {
public:
    /// Returns the number of a new job.
    std::uint64_t begin(const Term& term) {
        begun_in_ = term;
        fault_ = FaultCode::None;
        return number_ = ++newest_;
    }
    /// Returns the number of a job in the pause of the last one, which stays the last one.
    std::uint64_t begin_in_pause() { return ++newest_; }
    void end(JobOutcome outcome) { outcome_ = outcome; }
    /// The job ended early at this line: by a takeover, or because its program ended early.
    void cut(std::optional<std::int32_t> line, FaultCode why = FaultCode::None) {
        cut_job_ = number_;
        cut_line_ = line;
        fault_ = why;
        outcome_ = JobOutcome::Stopped;
    }
    /// Takes count and outcome from the last owner.
    void inherit(const MachineState& last) {
        number_ = newest_ = last.job;
        begun_in_ = last.job_begun;
        outcome_ = last.outcome;
        cut_job_ = 0;
    }

    std::uint64_t number() const { return number_; }
    const Term& begun_in() const { return begun_in_; }
    const std::optional<JobOutcome>& outcome() const { return outcome_; }
    std::optional<std::int32_t> line() const { return number_ == cut_job_ ? cut_line_ : std::nullopt; }
    FaultCode fault() const { return fault_; }

private:
    std::uint64_t newest_ = 0;  // of all jobs
    std::uint64_t number_ = 0;  // of the last job that began outside of a pause
    Term begun_in_;
    std::optional<JobOutcome> outcome_;  // of the last job that ended
    std::uint64_t cut_job_ = 0;
    std::optional<std::int32_t> cut_line_;
    FaultCode fault_ = FaultCode::None;  // why the program of the last job ended early
};

}  // namespace lockstep
