// Finds the parts of programs that were recorded in parts because they are too long for the job's message. Notes only
// the places of the parts; the parts stay in the log (recorded_program.hpp).
//
// A program may be received while it runs. Then its later parts follow the job in the log.
#pragma once

#include <cstdint>
#include <deque>
#include <expected>
#include <filesystem>
#include <lockstep/job_t.hpp>
#include <lockstep/program_part_t.hpp>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/record/reading/recorded_program.hpp"

namespace lockstep::analysis {

/// A job's message, with the places of its program's parts if the program was recorded in parts.
struct RecordedJob : job_t {
    RecordedJob() = default;
    explicit RecordedJob(job_t message) : job_t(std::move(message)) {}

    std::optional<ProgramPlaces> parts;
    std::string lacks;  // says which parts are not in the log; empty if all are

    bool has_program() const { return parts || !lacks.empty() || !program.empty(); }
    /// Axes may be jogged in the pause of a job, and return in it. A homing by touch consists of moves with programs.
    bool may_be_in_pause() const { return kind == "jog" || kind == "return" || (kind == "home" && has_program()); }
    /// Event probe: the name of the input that touched first; empty: none, or it is not on record.
    const std::string& input() const { return program; }
    bool has_program_of(const RecordedJob& other) const { return program == other.program && parts == other.parts; }
    /// Fails if the program cannot be read or is incomplete.
    std::expected<std::shared_ptr<const RecordedProgram>, std::string> read_program() const;
};

class ProgramParts {
public:
    static constexpr std::size_t kProgramsKept = 8;  // the newest
    static constexpr std::int32_t kMostParts = 1 << 20;

    explicit ProgramParts(std::filesystem::path log) : log_(std::move(log)) {}

    /// `offset`: where the part's message begins in the log. Fails if the part is impossible.
    std::expected<void, std::string> take(const program_part_t& part, std::uint64_t offset);
    /// Whether parts of the program of a begun job may follow in the log.
    bool is_open(const job_t& job) const;
    /// Takes a later part of this job's program, from any coordinator. Ignores parts of other programs.
    void take_later(const program_part_t& part, std::uint64_t offset, const job_t& job);
    /// Gives a begun job the places of its program, if the program was recorded in parts.
    void complete(RecordedJob& job) const;

private:
    struct Place {
        std::uint64_t offset = 0;
        std::size_t bytes = 0;
        std::size_t hash = 0;  // of the content
        bool has_same_content(const Place& other) const { return bytes == other.bytes && hash == other.hash; }
    };
    struct Parts {
        std::int64_t coordinator = 0;
        std::int64_t program = 0;
        std::vector<std::optional<Place>> places;
        std::size_t count = 0;  // of its parts; 0 before the last one has come

        bool fits(const program_part_t& part) const;
        std::size_t missing() const;
    };
    static Place place_of(const program_part_t& part, std::uint64_t offset);
    const Parts* find(std::int64_t coordinator, std::int64_t program) const;
    Parts& parts_of(const program_part_t& part);

    std::filesystem::path log_;
    std::deque<Parts> programs_;
    std::map<std::pair<std::int64_t, std::int64_t>, std::int64_t> of_jobs_;  // by coordinator and job
};

}  // namespace lockstep::analysis
