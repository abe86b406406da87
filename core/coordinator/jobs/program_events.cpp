#include "core/coordinator/jobs/program_events.hpp"

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

void ProgramEvents::switch_off(std::uint64_t job, const LoopView& loop, std::vector<PublishedEvent>& out) {
    const PublishedEvent off{.job = job, .tick = loop.now, .at_rest = true, .is_of_program = false};
    const auto switch_off = [&](ProgramEvent::Kind kind) {
        PublishedEvent event = off;
        event.event.kind = kind;
        publish(event, loop, out);
    };
    if (devices_.spindle != ProgramDevices::Spindle::Stopped) { switch_off(ProgramEvent::Kind::SpindleStop); }
    if (devices_.mist || devices_.flood) { switch_off(ProgramEvent::Kind::CoolantOff); }
}

}  // namespace lockstep
