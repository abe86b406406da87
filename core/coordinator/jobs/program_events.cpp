#include "core/coordinator/jobs/program_events.hpp"

namespace lockstep {

void ProgramEvents::publish(PublishedEvent event, CoordinatorLoop& loop) {
    event.term = loop.term;
    event.sequence = ++sequence_;
    devices_.apply(event.event);
    loop.out.events.push_back(event);
}

void ProgramEvents::happen(const PathEvent& event, Tick tick, const Of& of, CoordinatorLoop& loop) {
    if (event.block < from_) { return; }
    from_ = event.block + 1;
    publish({.job = of.job,
             .epoch = of.epoch,
             .tick = tick,
             .block = event.block,
             .line = event.line,
             .event = event.event},
            loop);
}

void ProgramEvents::pass(std::span<const PathEvent> events, const Of& of, CoordinatorLoop& loop) {
    for (const PathEvent& event : events) {
        if (event.block < from_) { continue; }
        from_ = event.block + 1;
        publish({.job = of.job,
                 .epoch = of.epoch,
                 .tick = loop.now,
                 .at_rest = true,
                 .block = event.block,
                 .line = event.line,
                 .event = event.event},
                loop);
    }
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
