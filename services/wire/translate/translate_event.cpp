#include "core/if_positive.hpp"
#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {

lockstep_wire_ProgramEvent to_wire(const PublishedEvent& event) {
    return {.term = event.term.number,
            .coordinator = event.term.coordinator,
            .number = event.sequence,
            .job = event.job,
            .epoch = event.epoch,
            .tick = event.tick.value,
            .at_rest = event.at_rest,
            .is_of_program = event.is_of_program,
            .block = event.block,
            .line = event.line.value_or(0),
            .kind = static_cast<std::uint8_t>(event.event.kind),
            .index = event.event.index,
            .value = event.event.value};
}

FromWire<PublishedEvent> from_wire(const lockstep_wire_ProgramEvent& wire) {
    Checks check("program event");
    check.far("tick", wire.tick);
    check.within<std::int32_t>("index", wire.index, 0, kMaxEventIndex);
    check.finite("value", wire.value);
    check.within<std::size_t>("kind", wire.kind, 0, kEventWords.size() - 1);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return PublishedEvent{
        .term = {wire.term, wire.coordinator},
        .sequence = wire.number,
        .job = wire.job,
        .epoch = wire.epoch,
        .tick = {wire.tick},
        .at_rest = wire.at_rest,
        .is_of_program = wire.is_of_program,
        .block = wire.block,
        .line = if_positive(wire.line),
        .event = {.kind = static_cast<ProgramEvent::Kind>(wire.kind), .index = wire.index, .value = wire.value}};
}

}  // namespace lockstep
