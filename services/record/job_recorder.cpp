#include "services/record/job_recorder.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/enumeration.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/names.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_document.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep {

JobRecorder::JobRecorder(const MachineSetup& machine, Identity coordinator, RecordSink& sink)
    : machine_(machine),
      coordinator_(coordinator),
      sink_(sink),
      channel_(job_channel(machine.name)),
      event_channel_(event_channel(machine.name)),
      config_(machine_text(machine)),
      marker_(machine, "", sink) {}

void JobRecorder::note_axis(const AxisHealth& health) {
    if (health.axis >= motor_count(machine_)) { return; }
    marker_.note(motor_name(machine_, MotorIndex{health.axis}), health.identity, health.published, health.tick);
}

void JobRecorder::record(Tick now, const JobEvent& event) {
    const std::string_view name = pick_name({"begun", "epoch", "ended", "override", "probe"}, event.kind);
    JobRecord record{.machine = machine_.name,
                     .coordinator = coordinator_,
                     .sequence = published_.job_events++,
                     .job = event.job,
                     .kind = std::string(name_of(event.job_kind)),
                     .event = std::string(name),
                     .epoch = event.epoch,
                     .start = event.start,
                     .resume_block = event.place.block,
                     .resume_along = event.place.along.raw,
                     .behind_frame = event.behind,
                     .overrides = event.overrides,
                     .start_count = {event.start_counts.begin(), event.start_counts.end()}};
    record.start_count.insert(record.start_count.end(), event.plays.begin(), event.plays.end());
    if (event.kind == JobEvent::Kind::Begun) {
        record.config = config_;
        if (event.program) { record_program(now, event, record); }
    }
    if (event.kind == JobEvent::Kind::Ended) { record.outcome = name_of(event.outcome); }
    if (event.probe) { add(*event.probe, record); }
    sink_.publish(channel_, to_lcm(record, now, machine_.tick_ns));
}

void JobRecorder::add(const ProbeResult& probe, JobRecord& record) const {
    record.outcome = probe.touched() ? "touched" : "missed";
    if (probe.input) { record.program = machine_.inputs[*probe.input].name; }
    record.start = probe.tick;
    for (const double mm : probe.places_mm) { record.start_count.push_back(std::llround(mm * kNmInMm)); }
}

void JobRecorder::record(Tick now, const PublishedEvent& event) {
    const EventRecord record{machine_.name, {coordinator_, published_.job_events++}, event};
    sink_.publish(event_channel_, to_lcm(record, now, machine_.tick_ns));
}

void JobRecorder::record(Tick now, const CoordinatorOutputs& out) {
    for (const PublishedEvent& event : out.events) { record(now, event); }
    for (const JobEvent& event : out.jobs) { record(now, event); }
}

void JobRecorder::record(Tick now, const ProgramChunk& chunk) {
    if (chunk.count == 1) { return; }
    if (std::ranges::find(in_parts_, chunk.program) == in_parts_.end()) { in_parts_.push_back(chunk.program); }
    if (in_parts_.size() > kProgramsKept) { in_parts_.pop_front(); }
    program_part_t part{};
    part.program = static_cast<std::int64_t>(chunk.program);
    part.part = static_cast<std::int32_t>(chunk.index);
    part.parts = static_cast<std::int32_t>(chunk.count.value_or(0));
    part.data = chunk.bytes;
    publish(now, std::move(part));
}

/// Puts a short program into the job's message. The parts of a longer one were recorded already, or are recorded now.
void JobRecorder::record_program(Tick now, const JobEvent& event, JobRecord& record) {
    const std::uint64_t id = event.program_id.value_or(0);
    bool is_in_parts = std::ranges::find(in_parts_, id) != in_parts_.end();
    const auto program = is_in_parts ? std::nullopt : event.program->whole();
    if (program && program->blocks.size() > kBlocksInJob) {
        record_parts(now, id, *program);
        is_in_parts = true;
    }
    if (!is_in_parts) {
        if (program) { record.program = program_text(*program); }
        return;
    }
    program_part_t part{};
    part.program = static_cast<std::int64_t>(id);
    part.job = static_cast<std::int64_t>(event.job);
    publish(now, std::move(part));
}

/// Records the program in parts of whole blocks. Only the last part says how many there are.
void JobRecorder::record_parts(Tick now, std::uint64_t id, const Program& program) {
    ProgramChunk chunk{.program = id};
    ProgramPartWriter writer(program.head());
    for (const Block& block : program.blocks) {
        writer.add(block);
        if (!writer.is_full()) { continue; }
        chunk.bytes = writer.take();
        record(now, chunk);
        ++chunk.index;
    }
    chunk.count = chunk.index + 1;
    chunk.bytes = writer.take();
    record(now, chunk);
}

/// Stamps the part one microsecond before the job, so that it precedes the job in merged logs too, which are sorted by
/// time.
void JobRecorder::publish(Tick now, program_part_t&& part) {
    part.utime = utime_of(now, machine_.tick_ns) - 1;
    part.machine = machine_.name;
    part.coordinator = static_cast<std::int64_t>(coordinator_);
    part.sequence = static_cast<std::int64_t>(published_.program_parts++);
    part.size = static_cast<std::int32_t>(part.data.size());
    sink_.publish(program_channel(machine_.name), part);
}

}  // namespace lockstep
