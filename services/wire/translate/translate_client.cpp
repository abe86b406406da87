#include <cstring>
#include <span>

#include "core/if_positive.hpp"
#include "services/wire/dds/cut_text.hpp"
#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"
#include "services/wire/translate/writer_text.hpp"

namespace lockstep {
namespace {

static_assert(lockstep_wire_COMMAND_GIVE_LEASE == static_cast<int>(CommandKind::GiveLease));
static_assert(lockstep_wire_REPLY_REFUSED == static_cast<int>(ReplyStatus::Refused));

}  // namespace

CommandMessage to_wire(const Command& command) {
    CommandMessage message;
    lockstep_wire_Command& wire = message;
    wire = {.client = command.client,
            .sequence_number = command.sequence,
            .kind = static_cast<lockstep_wire_CommandKind>(command.kind),
            .axes = command.axes.bits(),
            .program = command.program,
            .ticks = command.ticks.value_or(Ticks{}).value,
            .feed_percent = static_cast<std::uint16_t>(command.feed_percent.value_or(0)),
            .rapid_percent = static_cast<std::uint16_t>(command.rapid_percent.value_or(0)),
            .jogs = {},
            .writer = command.writer.id,
            .writer_name = {},
            .writer_host = {},
            .takes_over = command.takes_over,
            .returns = command.returns};
    write_text(command.writer.name, wire.writer_name);
    write_text(command.writer.host, wire.writer_host);
    for (const JogAxis& jog : command.jogs) {
        message.jog_storage.push_back({.axis = static_cast<std::uint32_t>(jog.axis),
                                       .speed_mm_s = jog.speed_mm_s,
                                       .distance_mm = jog.distance_mm.value_or(0)});
    }
    const auto size = static_cast<std::uint32_t>(message.jog_storage.size());
    wire.jogs = {._maximum = size, ._length = size, ._buffer = message.jog_storage.data(), ._release = false};
    return message;
}

FromWire<Command> from_wire(const lockstep_wire_Command& wire) {
    Checks check("command");
    const CommandKind kind = check.choice("kind", wire.kind, CommandKind::GiveLease);
    check.within<std::int64_t>("ticks", wire.ticks, 0, kMaxWireTicks);
    check.within<std::size_t>("the number of jogs", wire.jogs._length, 0, lockstep_wire_MAX_JOGS);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    LeaseHolder writer{wire.writer, std::string(read_text("writer_name", wire.writer_name, check)),
                       std::string(read_text("writer_host", wire.writer_host, check))};
    std::vector<JogAxis> jogs;
    for (const auto& jog : std::span(wire.jogs._buffer, wire.jogs._length)) {
        check.within<std::size_t>("a jog's axis", jog.axis, 0, kMaxAxes - 1);
        check.finite("a jog's speed_mm_s", jog.speed_mm_s);
        check.finite("a jog's distance_mm", jog.distance_mm);
        jogs.push_back({AxisIndex{jog.axis}, jog.speed_mm_s, if_positive(jog.distance_mm)});
    }
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return Command{.client = wire.client,
                   .sequence = wire.sequence_number,
                   .kind = kind,
                   .axes = AxisSet::of_bits(wire.axes),
                   .program = wire.program,
                   .ticks = if_positive(Ticks{wire.ticks}),
                   .feed_percent = if_positive(wire.feed_percent),
                   .rapid_percent = if_positive(wire.rapid_percent),
                   .jogs = std::move(jogs),
                   .writer = std::move(writer),
                   .takes_over = wire.takes_over,
                   .returns = wire.returns};
}

lockstep_wire_ProgramChunk to_wire(const ProgramChunk& chunk) {
    const auto size = static_cast<std::uint32_t>(chunk.bytes.size());
    return {.client = chunk.client,
            .sequence_number = chunk.sequence,
            .program = chunk.program,
            .index = chunk.index,
            .count = chunk.count.value_or(0),
            .share = chunk.share.value_or(0),
            .writer = chunk.writer,
            .bytes = {._maximum = size,
                      ._length = size,
                      ._buffer = const_cast<std::uint8_t*>(chunk.bytes.data()),  // DDS only reads it
                      ._release = false}};
}

FromWire<ProgramChunk> from_wire(const lockstep_wire_ProgramChunk& wire) {
    Checks check("program chunk");
    check.within<std::uint32_t>("count", wire.count, 0, kMaxChunks);
    check.within<std::int64_t>("index", wire.index, 0, std::int64_t{wire.count == 0 ? kMaxChunks : wire.count} - 1);
    check.within("share", wire.share, 0.0, 1.0);
    check.within<std::size_t>("the number of bytes", wire.bytes._length, 0, kMaxChunkBytes);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return ProgramChunk{.client = wire.client,
                        .sequence = wire.sequence_number,
                        .program = wire.program,
                        .index = wire.index,
                        .count = if_positive(wire.count),
                        .share = if_positive(wire.share),
                        .bytes = {wire.bytes._buffer, wire.bytes._buffer + wire.bytes._length},
                        .writer = wire.writer};
}

lockstep_wire_Reply to_wire(const Reply& reply) {
    lockstep_wire_Reply wire{.client = reply.client,
                             .sequence_number = reply.sequence,
                             .status = static_cast<lockstep_wire_ReplyStatus>(reply.status),
                             .fault = static_cast<std::uint16_t>(reply.fault),
                             .job = reply.job,
                             .parts = reply.parts,
                             .free_blocks = reply.free_blocks,
                             .text = {}};
    const std::string text = cut_text(reply.text, lockstep_wire_MAX_REPLY_BYTES);
    std::memcpy(wire.text, text.data(), text.size());
    return wire;
}

FromWire<Reply> from_wire(const lockstep_wire_Reply& wire) {
    Checks check("reply");
    const ReplyStatus status = check.choice("status", wire.status, ReplyStatus::Refused);
    const std::size_t length = strnlen(wire.text, sizeof wire.text);
    check.within<std::size_t>("the text's length", length, 0, lockstep_wire_MAX_REPLY_BYTES);
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    return Reply{.client = wire.client,
                 .sequence = wire.sequence_number,
                 .status = status,
                 .fault = static_cast<FaultCode>(wire.fault),
                 .job = wire.job,
                 .text = std::string(wire.text, length),
                 .parts = wire.parts,
                 .free_blocks = wire.free_blocks};
}

}  // namespace lockstep
