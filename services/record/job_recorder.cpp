#include "services/record/job_recorder.hpp"

#include <array>

#include "services/documents/machine_file.hpp"
#include "services/documents/program_document.hpp"
#include "services/wire/lcm_channels.hpp"
#include "services/wire/translate_lcm.hpp"

namespace lockstep {

std::string_view name_of(JobKind kind) {
    constexpr std::array<std::string_view, 4> kNames{"home", "move", "run", "own-move"};
    return kNames[static_cast<std::size_t>(kind)];
}

std::string_view name_of(JobOutcome outcome) {
    constexpr std::array<std::string_view, 3> kNames{"done", "stopped", "failed"};
    return kNames[static_cast<std::size_t>(outcome)];
}

JobRecorder::JobRecorder(const MachineConfig& machine, Identity coordinator, RecordSink& sink)
    : machine_(machine),
      coordinator_(coordinator),
      sink_(sink),
      channel_(job_channel(machine.name)),
      config_(machine_text(machine)) {}

void JobRecorder::record(Tick now, const JobEvent& event) {
    constexpr std::array<const char*, 4> kEvents{"begun", "epoch", "ended", "override"};
    JobRecord record{.machine = machine_.name,
                     .coordinator = coordinator_,
                     .sequence = events_++,
                     .job = event.job,
                     .kind = std::string(name_of(event.job_kind)),
                     .event = kEvents[static_cast<std::size_t>(event.kind)],
                     .epoch = event.epoch,
                     .start = event.start,
                     .resume_block = event.place.block,
                     .resume_along = event.place.along.raw,
                     .behind_frame = event.behind,
                     .overrides = event.overrides,
                     .start_count = event.start_counts};
    if (event.kind == JobEvent::Kind::Begun) {
        record.config = config_;
        if (event.program) { record.program = program_text(*event.program); }
    }
    if (event.kind == JobEvent::Kind::Ended) { record.outcome = name_of(event.outcome); }
    sink_.publish(channel_, to_lcm(record, now, machine_.tick_ns));
}

}  // namespace lockstep
