#include "core/coordinator/jobs/program_events.hpp"

#include "core/outputs/output_levels.hpp"

namespace lockstep {

void ProgramEvents::publish(PublishedEvent event, const LoopView& loop, std::vector<PublishedEvent>& out) {
    event.term = loop.term;
    event.sequence = ++sequence_;
    devices_.apply(event.event);
    out.push_back(event);
}

/// Publishes each event once. Leaves out events that were published before.
void ProgramEvents::publish(const PathEvent& event, PublishedEvent place, const LoopView& loop,
                            std::vector<PublishedEvent>& out) {
    if (event.block < from_) { return; }
    from_ = event.block + 1;
    place.block = event.block;
    place.line = event.line;
    place.event = event.event;
    publish(place, loop, out);
}

void ProgramEvents::happen(const PathEvent& event, Tick tick, const Of& of, const LoopView& loop,
                           std::vector<PublishedEvent>& out) {
    publish(event, {.job = of.job, .epoch = of.epoch, .tick = tick}, loop, out);
}

void ProgramEvents::pass(const PathEvent& event, const Of& of, const LoopView& loop, std::vector<PublishedEvent>& out) {
    publish(event, {.job = of.job, .epoch = of.epoch, .tick = loop.now, .at_rest = true}, loop, out);
}

void ProgramEvents::switch_off(std::uint64_t job, JobOutcome outcome, const LoopView& loop,
                               std::vector<PublishedEvent>& out) {
    for (const ProgramEvent& word : devices_.words_off()) { end_by(word, job, loop, out); }
    switch_off_outputs(job, outcome, loop, out);
}

void ProgramEvents::switch_off_outputs(std::uint64_t job, JobOutcome outcome, const LoopView& loop,
                                       std::vector<PublishedEvent>& out) {
    for (const OutputConfig& output : loop.machine.outputs) {
        const bool goes_off = !output.stays_after(outcome == JobOutcome::Failed) && is_active(output, devices_);
        if (goes_off) { end_by(end_of(output), job, loop, out); }
    }
}

void ProgramEvents::end_by(const ProgramEvent& end, std::uint64_t job, const LoopView& loop,
                           std::vector<PublishedEvent>& out) {
    publish({.job = job, .tick = loop.now, .at_rest = true, .is_of_program = false, .event = end}, loop, out);
}

}  // namespace lockstep
