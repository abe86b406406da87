// The coordinator's part of the record: each job with the machine and the program whole, so that a log speaks for
// itself.
#pragma once

#include <string>

#include "core/coordinator/coordinator.hpp"
#include "services/record/record_sink.hpp"

namespace lockstep {

class JobRecorder {
public:
    JobRecorder(const MachineConfig& machine, Identity coordinator, RecordSink& sink);
    void record(Tick now, const JobEvent& event);

private:
    MachineConfig machine_;
    Identity coordinator_;
    RecordSink& sink_;
    std::string channel_;
    std::string config_;
    std::uint64_t events_ = 0;  // recorded
};

/// "home", "move", "run", "own-move"; "done", "stopped", "failed": as the record and the reports have them.
std::string_view name_of(JobKind kind);
std::string_view name_of(JobOutcome outcome);

}  // namespace lockstep
