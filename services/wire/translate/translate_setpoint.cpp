#include <numeric>
#include <span>

#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {
namespace {

static_assert(kMaxAxes == lockstep_wire_MAX_AXES);
static_assert(kMaxAxes * (kMaxBodyPieces + kMaxTailPieces) <= lockstep_wire_MAX_FRAME_PIECES);

/// Makes a sequence of the IDL point to a vector's elements.
template <typename Sequence, typename T>
void show(Sequence& sequence, std::vector<T>& items) {
    sequence._buffer = items.data();
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(items.size());
    sequence._release = false;
}

template <typename Sequence>
auto elements(const Sequence& sequence) {
    return std::span(sequence._buffer, sequence._length);
}

std::size_t sum(std::span<const std::uint16_t> counts) {
    return std::accumulate(counts.begin(), counts.end(), std::size_t{0});
}

void make_room(SetpointMessage::Storage& storage, const Frame& frame) {
    std::size_t pieces = 0;
    for (const AxisTrack& axis : frame.axes) { pieces += axis.body.size() + axis.tail.size(); }
    for (auto* items : {&storage.ticks, &storage.velocity, &storage.acceleration}) {
        items->clear();
        items->reserve(pieces);
    }
    storage.from_count.clear();
    storage.from_phase.clear();
    storage.body_count.clear();
    storage.tail_count.clear();
}

void append(SetpointMessage::Storage& storage, const AxisTrack& axis) {
    storage.from_count.push_back(axis.from.count());
    storage.from_phase.push_back(axis.from.phase());
    storage.body_count.push_back(static_cast<std::uint16_t>(axis.body.size()));
    storage.tail_count.push_back(static_cast<std::uint16_t>(axis.tail.size()));
    const auto append_piece = [&](const Piece& piece) {
        storage.ticks.push_back(piece.ticks.value);
        storage.velocity.push_back(piece.velocity.raw);
        storage.acceleration.push_back(piece.acceleration.raw);
    };
    for (const Piece& piece : axis.body) { append_piece(piece); }
    for (const Piece& piece : axis.tail) { append_piece(piece); }
}

/// Checks that the counts match. After this every index below is within its sequence.
void check_shape(const lockstep_wire_Setpoint& wire, Checks& check) {
    const std::size_t axes = wire.from_count._length;
    check.within<std::size_t>("the number of axes", axes, 1, kMaxAxes);
    check.same("the number of phases", wire.from_phase._length, axes);
    check.same("the number of body counts", wire.body_count._length, axes);
    check.same("the number of tail counts", wire.tail_count._length, axes);
    if (!check.passed()) { return; }
    for (const auto count : elements(wire.body_count)) {
        check.within<std::size_t>("a body count", count, 0, kMaxBodyPieces);
    }
    for (const auto count : elements(wire.tail_count)) {
        check.within<std::size_t>("a tail count", count, 0, kMaxTailPieces);
    }
    const std::size_t pieces = sum(elements(wire.body_count)) + sum(elements(wire.tail_count));
    check.same("the number of ticks", wire.ticks._length, pieces);
    check.same("the number of velocities", wire.velocity._length, pieces);
    check.same("the number of accelerations", wire.acceleration._length, pieces);
}

void check_values(const lockstep_wire_Setpoint& wire, Checks& check) {
    check.far("start_tick", wire.start_tick);
    check.within<std::int64_t>("frame_ticks", wire.frame_ticks, 1, kMaxWireTicks);
    for (const auto count : elements(wire.from_count)) { check.far("from_count", count); }
    for (const auto ticks : elements(wire.ticks)) { check.within<std::int64_t>("ticks", ticks, 0, kMaxWireTicks); }
    for (const auto velocity : elements(wire.velocity)) { check.rate("velocity", velocity); }
    for (const auto acceleration : elements(wire.acceleration)) { check.rate("acceleration", acceleration); }
}

/// Copies `count` pieces from index `at` of the sequences on, and advances `at`. The target has room, because the shape
/// was checked.
template <typename Pieces>
void read_pieces(const lockstep_wire_Setpoint& wire, std::size_t& at, std::size_t count, Pieces& pieces) {
    pieces.clear();
    for (const std::size_t end = at + count; at < end; ++at) {
        (void)pieces.push_back(
            {{wire.ticks._buffer[at]}, {wire.velocity._buffer[at]}, {wire.acceleration._buffer[at]}});
    }
}

}  // namespace

SetpointMessage to_wire(const Frame& frame) {
    SetpointMessage message;
    to_wire(frame, message);
    return message;
}

void to_wire(const Frame& frame, SetpointMessage& message) {
    message.term = frame.term.number;
    message.coordinator = frame.term.coordinator;
    message.epoch = frame.epoch;
    message.number = frame.number;
    message.start_tick = frame.start.value;
    message.frame_ticks = frame.ticks.value;
    message.last = frame.last;
    SetpointMessage::Storage& storage = message.storage;
    make_room(storage, frame);
    for (const AxisTrack& axis : frame.axes) { append(storage, axis); }
    show(message.from_count, storage.from_count);
    show(message.from_phase, storage.from_phase);
    show(message.body_count, storage.body_count);
    show(message.tail_count, storage.tail_count);
    show(message.ticks, storage.ticks);
    show(message.velocity, storage.velocity);
    show(message.acceleration, storage.acceleration);
}

FromWire<Frame> from_wire(const lockstep_wire_Setpoint& wire) {
    Frame frame;
    if (auto read = from_wire(wire, frame); !read) { return std::unexpected(std::move(read.error())); }
    return frame;
}

std::expected<void, std::string> from_wire(const lockstep_wire_Setpoint& wire, Frame& into) {
    Checks check("setpoint");
    check_shape(wire, check);
    if (check.passed()) { check_values(wire, check); }
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    into.term = {wire.term, wire.coordinator};
    into.epoch = wire.epoch;
    into.number = wire.number;
    into.start = {wire.start_tick};
    into.ticks = {wire.frame_ticks};
    into.last = wire.last;
    into.axes.resize(wire.from_count._length);
    std::size_t at = 0;
    for (std::size_t i = 0; i < into.axes.size(); ++i) {
        AxisTrack& axis = into.axes[i];
        axis.from = Position::from_count(wire.from_count._buffer[i], wire.from_phase._buffer[i]);
        read_pieces(wire, at, wire.body_count._buffer[i], axis.body);
        read_pieces(wire, at, wire.tail_count._buffer[i], axis.tail);
    }
    return {};
}

}  // namespace lockstep
