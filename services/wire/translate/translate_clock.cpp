#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {

lockstep_wire_ClockRequest to_wire(const ClockRequest& request) {
    return {.axis = request.axis,
            .identity = request.identity,
            .sequence_number = request.sequence,
            .sent = request.sent.value};
}

FromWire<ClockRequest> from_wire(const lockstep_wire_ClockRequest& wire) {
    Checks check("clock request");
    check.within<std::size_t>("axis", wire.axis, 0, kMaxAxes - 1);
    check.far("sent", wire.sent);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return ClockRequest{
        .axis = wire.axis, .identity = wire.identity, .sequence = wire.sequence_number, .sent = {wire.sent}};
}

lockstep_wire_ClockReply to_wire(const ClockReply& reply) {
    return {.axis = reply.request.axis,
            .identity = reply.request.identity,
            .sequence_number = reply.request.sequence,
            .sent = reply.request.sent.value,
            .received = reply.received.value,
            .answered = reply.answered.value};
}

FromWire<ClockReply> from_wire(const lockstep_wire_ClockReply& wire) {
    Checks check("clock reply");
    check.within<std::size_t>("axis", wire.axis, 0, kMaxAxes - 1);
    check.far("sent", wire.sent);
    check.far("received", wire.received);
    check.far("answered", wire.answered);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return ClockReply{.request = {.axis = wire.axis,
                                  .identity = wire.identity,
                                  .sequence = wire.sequence_number,
                                  .sent = {wire.sent}},
                      .received = {wire.received},
                      .answered = {wire.answered}};
}

}  // namespace lockstep
