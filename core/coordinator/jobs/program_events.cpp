#include "core/coordinator/jobs/program_events.hpp"

namespace lockstep {

void ProgramEvents::publish(PublishedEvent event, CoordinatorLoop& loop) {
    event.term = loop.term;
    event.sequence = ++sequence_;
    devices_.apply(event.event);
    loop.out.events.push_back(event);
}

/// Publishes each event once. Leaves out events that were published before.
void ProgramEvents::publish(const PathEvent& event, PublishedEvent place, CoordinatorLoop& loop) {
    if (event.block < from_) { return; }
    from_ = event.block + 1;
    place.block = event.block;
    place.line = event.line;
    place.event = event.event;
    publish(place, loop);
}

void ProgramEvents::happen(const PathEvent& event, Tick tick, const Of& of, CoordinatorLoop& loop) {
    publish(event, {.job = of.job, .epoch = of.epoch, .tick = tick}, loop);
}

void ProgramEvents::pass(const PathEvent& event, const Of& of, CoordinatorLoop& loop) {
    publish(event, {.job = of.job, .epoch = of.epoch, .tick = loop.now, .at_rest = true}, loop);
}

void ProgramEvents::switch_off(std::uint64_t job, CoordinatorLoop& loop) {
    const PublishedEvent off{.job = job, .tick = loop.now, .at_rest = true, .is_of_program = false};
    const auto switch_off = [&](ProgramEvent::Kind kind) {
        PublishedEvent event = off;
        event.event.kind = kind;
        publish(event, loop);
    };
    if (devices_.spindle != ProgramDevices::Spindle::Stopped) { switch_off(ProgramEvent::Kind::SpindleStop); }
    if (devices_.mist || devices_.flood) { switch_off(ProgramEvent::Kind::CoolantOff); }
}

}  // namespace lockstep
