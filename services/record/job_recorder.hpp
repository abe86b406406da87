// The coordinator's part of the record: each job with the machine and the program whole, so that a log speaks for
// itself.
#pragma once

#include <deque>
#include <lockstep/program_part_t.hpp>
#include <string>

#include "core/coordinator/coordinator.hpp"
#include "core/protocol/axis_health.hpp"
#include "services/record/record_sink.hpp"
#include "services/record/record_witness.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {

class JobRecorder {
public:
    JobRecorder(const MachineConfig& machine, Identity coordinator, RecordSink& sink);
    /// Each loop, before its events.
    void note(Tick now) { witness_.note("", coordinator_, published_, now); }
    /// What an axis is known to have published.
    void note_axis(const AxisHealth& health);
    void record(Tick now, const JobEvent& event);
    /// A part of a program, as it came. A program of several is recorded in these parts: a long one in one message
    /// would find no room in the queue to the disk, and hold up the loop that writes it.
    void record(Tick now, const ProgramChunk& chunk);
    RecordCounts published() const { return published_; }
    /// At the end.
    void finish(Tick now) { witness_.note_end("", coordinator_, published_, now); }

private:
    static constexpr std::size_t kBlocksInJob = 2000;  // the most that a job's own message carries
    static constexpr std::size_t kPartBytes = 32'768;
    static constexpr std::size_t kProgramsKept = 16;  // more than the coordinator keeps

    void record_program(Tick now, const JobEvent& event, JobRecord& record);
    void record_parts(Tick now, const JobEvent& event);
    void publish(Tick now, program_part_t&& part);

    MachineConfig machine_;
    Identity coordinator_;
    RecordSink& sink_;
    std::string channel_;
    std::string config_;
    std::deque<std::uint64_t> in_parts_;  // programs recorded so, the newest
    RecordCounts published_;
    RecordWitness witness_;
};

/// "home", "move", "run", "own-move"; "done", "stopped", "failed": as the record and the reports have them.
std::string_view name_of(JobKind kind);
std::string_view name_of(JobOutcome outcome);

}  // namespace lockstep
