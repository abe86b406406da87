// The events of a job's program, in their order, and how many of them were found on record.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>

#include "core/coordinator/path/event_queue.hpp"
#include "services/record/reading/recorded_program.hpp"

namespace lockstep::verification {

class PlannedEvents {
public:
    /// `program`: null if it has no events.
    void begin(std::shared_ptr<const analysis::RecordedProgram> program) {
        program_ = std::move(program);
        done_ = 0;
    }
    bool is_done() const { return !program_ || done_ == program_->events().size(); }
    /// The block of the next one. There must be one.
    std::uint32_t block() const { return program_->events()[done_]; }
    PathEvent next() const {
        const Block* its = program_->block(block());
        if (its == nullptr) { return {block(), 0, {}}; }  // the log was altered: JobCheck reports it
        return {block(), its->line, std::get<ProgramEvent>(its->action)};
    }
    void pass() { ++done_; }
    /// The events before this block were passed.
    std::int64_t from() const { return done_ == 0 ? 0 : program_->events()[done_ - 1] + std::int64_t{1}; }

private:
    std::shared_ptr<const analysis::RecordedProgram> program_;
    std::size_t done_ = 0;
};

}  // namespace lockstep::verification
