// Records the coordinator's jobs, each with the complete machine and program, so that a log is self-contained.
#pragma once

#include <deque>
#include <lockstep/program_part_t.hpp>
#include <string>

#include "core/coordinator/state/coordinator_io.hpp"
#include "core/protocol/axis_health.hpp"
#include "services/record/record_marker.hpp"
#include "services/record/record_sink.hpp"
#include "services/setup/machine_setup.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {

class JobRecorder {
public:
    JobRecorder(const MachineSetup& machine, Identity coordinator, RecordSink& sink);
    /// Call it in each loop, before its events.
    void note(Tick now) { marker_.note("", coordinator_, published_, now); }
    /// Notes the counts that an axis has published.
    void note_axis(const AxisHealth& health);
    void record(Tick now, const JobEvent& event);
    void record(Tick now, const PublishedEvent& event);
    /// Records the outputs of a coordinator's step: first events of programs, then of jobs, as in merged logs.
    void record(Tick now, const CoordinatorOutputs& out);
    /// Records a part of a program when it was taken. A program of more than one part is recorded in these parts,
    /// because one message with all of it would not fit into the queue to the disk and would delay the loop.
    void record(Tick now, const ProgramChunk& chunk);
    RecordCounts published() const { return published_; }
    /// Call it at the end.
    void finish(Tick now) { marker_.note_end("", coordinator_, published_, now); }

private:
    static constexpr std::size_t kBlocksInJob = 2000;  // most blocks in a job's own message
    static constexpr std::size_t kProgramsKept = 16;   // more than the coordinator keeps

    void add(const ProbeResult& probe, JobRecord& record) const;
    void record_program(Tick now, const JobEvent& event, JobRecord& record);
    void record_parts(Tick now, std::uint64_t id, const Program& program);
    void publish(Tick now, program_part_t&& part);

    MachineConfig machine_;
    Identity coordinator_;
    RecordSink& sink_;
    std::string channel_;
    std::string event_channel_;
    std::string config_;
    std::deque<std::uint64_t> in_parts_;  // the newest programs recorded in parts
    RecordCounts published_;
    RecordMarker marker_;
};

}  // namespace lockstep
