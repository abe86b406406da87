// The events of programs in a log, as the coordinator published them, with their time and place on the path.
#pragma once

#include <cstddef>
#include <cstdint>
#include <lockstep/job_t.hpp>
#include <lockstep/program_event_t.hpp>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/program.hpp"
#include "core/units.hpp"
#include "services/record/reading/recorded_program.hpp"

namespace lockstep::analysis {

/// A place in machine coordinates, for each axis of the program, in mm or degrees.
using ProgramPlace = std::vector<std::pair<std::string, double>>;

struct HappenedEvent {
    Tick at;  // machine time when the motion reached the place; at rest, when the event was published
    ProgramEvent event;
    std::int64_t coordinator = 0;
    std::uint64_t job = 0;
    std::int64_t block = 0;            // of the program
    std::optional<std::int32_t> line;  // of the G-code file
    bool at_rest = false;
    bool is_of_program = true;  // false: the job ended early and the coordinator switched the device off
    ProgramPlace place;         // empty if the log lacks the program, or if not of the program
};

class ProgramEventLog {
public:
    static constexpr std::size_t kEventsKept = 1000;

    /// Call when a job begins. The log may have events of the job before its beginning.
    void begin(const job_t& job, const RecordedProgram& program);
    void end(const job_t& job);
    /// `event`: the decoded content of the message.
    void take(const program_event_t& message, const ProgramEvent& event);

    std::vector<HappenedEvent>& events() { return events_; }  // the first kEventsKept, in the order of the log
    std::uint64_t not_kept() const { return not_kept_; }

private:
    void note_places(const RecordedProgram& program, std::size_t at_most);
    void find_place(HappenedEvent& event) const;

    std::vector<HappenedEvent> events_;
    std::uint64_t not_kept_ = 0;
    std::optional<std::uint64_t> job_;             // in progress
    std::map<std::int64_t, ProgramPlace> places_;  // of the job's first events, by block
};

}  // namespace lockstep::analysis
