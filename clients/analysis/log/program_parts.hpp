// Assembles programs that were recorded in parts, since they are too long for the message of the job that runs them.
//
// A program may be received while it runs: its later parts then follow the job. The program in a job's message may only
// be read by program_of().
#pragma once

#include <cstdint>
#include <deque>
#include <expected>
#include <lockstep/job_t.hpp>
#include <lockstep/program_part_t.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/program.hpp"

namespace lockstep::analysis {

class ProgramParts {
public:
    static constexpr std::size_t kProgramsKept = 8;  // the newest
    static constexpr std::int32_t kMostParts = 1 << 20;

    /// Error: the part is impossible.
    std::expected<void, std::string> take(const program_part_t& part);
    /// Of a begun job: parts of its program may follow.
    bool is_open(const job_t& job) const;
    /// A later part of this job's program, by whichever coordinator. Others are left out.
    void take_later(const program_part_t& part, const job_t& job);
    /// Gives a begun job its program, if that was recorded in parts.
    void complete(job_t& job) const;

private:
    struct Parts {
        std::int64_t coordinator = 0;
        std::int64_t program = 0;
        std::vector<std::optional<std::vector<std::uint8_t>>> data;
        std::size_t count = 0;  // of its parts; 0: the last one has not come

        bool fits(const program_part_t& part) const;
        std::size_t missing() const;
    };
    const Parts* find(std::int64_t coordinator, std::int64_t program) const;
    Parts& parts_of(const program_part_t& part);
    std::string program_in_parts(std::int64_t coordinator, std::int64_t program) const;

    std::deque<Parts> programs_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> of_jobs_;  // by coordinator and job
};

/// False: parts of the job's program are not in the log; program_of() reports which.
bool has_whole_program(const job_t& job);
/// The program of a job. Error: it cannot be read, or is incomplete.
std::expected<Program, std::string> program_of(const job_t& job);

}  // namespace lockstep::analysis
