#include <numeric>
#include <span>

#include "services/wire/translate/checks.hpp"
#include "services/wire/translate/translate.hpp"

namespace lockstep {
namespace {

static_assert(kMaxAxes == lockstep_wire_MAX_AXES);
static_assert(kMaxAxes * (OutputTrack::kMostInBody + OutputTrack::kMostInTail) <= lockstep_wire_MAX_OUTPUT_CHANGES);
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

/// Appends the changes of one motor's outputs.
class OutputWriter {
public:
    explicit OutputWriter(SetpointMessage::Storage& storage) : storage_(storage) {
        for (auto* items : {&storage.output_at, &storage.output_value, &storage.output_slope}) { items->clear(); }
        storage.output_motor.clear();
        storage.output_body_count.clear();
        storage.output_tail_count.clear();
        storage.output_channel.clear();
    }
    void append(const MotorOutputs& outputs) {
        storage_.output_motor.push_back(static_cast<std::uint8_t>(outputs.motor));
        storage_.output_body_count.push_back(static_cast<std::uint16_t>(outputs.track.body.size()));
        storage_.output_tail_count.push_back(static_cast<std::uint16_t>(outputs.track.tail.size()));
        for (const OutputChange& change : outputs.track.body) { append(change); }
        for (const OutputChange& change : outputs.track.tail) { append(change); }
    }

private:
    void append(const OutputChange& change) {
        storage_.output_at.push_back(change.at.value);
        if (const auto* analog = std::get_if<RampAnalog>(&change.what)) {
            return append(analog->channel, analog->value, analog->slope);
        }
        if (const auto* digital = std::get_if<SetDigital>(&change.what)) {
            return append(lockstep_wire_DIGITAL_OUTPUTS, digital->levels + (std::int64_t{digital->mask} << 16), 0);
        }
        const auto& pulses = std::get<ComparePosition>(change.what);
        append(lockstep_wire_PULSES_AT_PLACES, pulses.next, slope_of(pulses));
    }
    static std::int64_t slope_of(const ComparePosition& pulses) {
        const auto every = static_cast<std::uint32_t>(pulses.every);
        return static_cast<std::int64_t>(std::uint64_t{pulses.pulses} << 32 | every);
    }
    void append(std::uint8_t channel, std::int64_t value, std::int64_t slope) {
        storage_.output_channel.push_back(channel);
        storage_.output_value.push_back(value);
        storage_.output_slope.push_back(slope);
    }

    SetpointMessage::Storage& storage_;
};

void check_change(const lockstep_wire_Setpoint& wire, std::size_t at, Checks& check) {
    const std::uint8_t channel = wire.output_channel._buffer[at];
    const std::int64_t value = wire.output_value._buffer[at];
    if (channel == lockstep_wire_PULSES_AT_PLACES) { return check.far("the place of a pulse", value); }
    const bool is_digital = channel == lockstep_wire_DIGITAL_OUTPUTS;
    const std::int64_t most = is_digital ? std::int64_t{1} << 32 : kFullScale;
    check.within<std::size_t>("an output channel", channel, 0,
                              is_digital ? lockstep_wire_DIGITAL_OUTPUTS : kMostAnalogOutputs - 1);
    check.within<std::int64_t>("an output value", value, 0, is_digital ? most - 1 : most);
    check.within<std::int64_t>("an output slope", wire.output_slope._buffer[at], is_digital ? 0 : -kFullScale,
                               is_digital ? 0 : kFullScale);
}

/// Checks the counts of outputs, as check_shape does those of pieces.
void check_outputs(const lockstep_wire_Setpoint& wire, Checks& check) {
    const std::size_t motors = wire.output_motor._length;
    check.within<std::size_t>("the number of motors with outputs", motors, 0, kMaxAxes);
    check.same("the number of output body counts", wire.output_body_count._length, motors);
    check.same("the number of output tail counts", wire.output_tail_count._length, motors);
    if (!check.passed()) { return; }
    for (const auto motor : elements(wire.output_motor)) {
        check.within<std::size_t>("a motor with outputs", motor, 0, kMaxAxes - 1);
    }
    for (const auto count : elements(wire.output_body_count)) {
        check.within<std::size_t>("an output body count", count, 0, OutputTrack::kMostInBody);
    }
    for (const auto count : elements(wire.output_tail_count)) {
        check.within<std::size_t>("an output tail count", count, 0, OutputTrack::kMostInTail);
    }
    const std::size_t changes = sum(elements(wire.output_body_count)) + sum(elements(wire.output_tail_count));
    check.same("the number of output ticks", wire.output_at._length, changes);
    check.same("the number of output channels", wire.output_channel._length, changes);
    check.same("the number of output values", wire.output_value._length, changes);
    check.same("the number of output slopes", wire.output_slope._length, changes);
    for (const auto at : elements(wire.output_at)) {
        check.within<std::int64_t>("an output tick", at, 1, kMaxWireTicks);
    }
    for (std::size_t i = 0; i < changes && check.passed(); ++i) { check_change(wire, i, check); }
}

OutputChange read_change(const lockstep_wire_Setpoint& wire, std::size_t at) {
    const Ticks tick{wire.output_at._buffer[at]};
    const std::uint8_t channel = wire.output_channel._buffer[at];
    const std::int64_t value = wire.output_value._buffer[at];
    if (channel == lockstep_wire_PULSES_AT_PLACES) {
        const auto slope = static_cast<std::uint64_t>(wire.output_slope._buffer[at]);
        return {tick, ComparePosition{.next = value,
                                      .every = static_cast<std::int32_t>(static_cast<std::uint32_t>(slope)),
                                      .pulses = static_cast<std::uint32_t>(slope >> 32)}};
    }
    if (channel != lockstep_wire_DIGITAL_OUTPUTS) {
        return {tick, RampAnalog{channel, value, wire.output_slope._buffer[at]}};
    }
    return {tick, SetDigital{static_cast<std::uint16_t>(value & 0xffff), static_cast<std::uint16_t>(value >> 16)}};
}

/// The target has room, because the shape was checked.
template <typename Changes>
void read_changes(const lockstep_wire_Setpoint& wire, std::size_t& at, std::size_t count, Changes& changes) {
    changes.clear();
    for (const std::size_t end = at + count; at < end; ++at) { changes.append(read_change(wire, at)); }
}

void read_outputs(const lockstep_wire_Setpoint& wire, std::vector<MotorOutputs>& outputs) {
    outputs.resize(wire.output_motor._length);
    std::size_t at = 0;
    for (std::size_t i = 0; i < outputs.size(); ++i) {
        outputs[i].motor = wire.output_motor._buffer[i];
        read_changes(wire, at, wire.output_body_count._buffer[i], outputs[i].track.body);
        read_changes(wire, at, wire.output_tail_count._buffer[i], outputs[i].track.tail);
    }
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

void check_touch(const lockstep_wire_Setpoint& wire, Checks& check) {
    check.within<std::size_t>("the number of touch_motor", wire.touch_motor._length, 0, kMaxTouchInputs);
    check.same("the number of touch_channel", wire.touch_channel._length, wire.touch_motor._length);
    if (wire.touch_ceases) {
        check.within<std::size_t>("the number of touch_motor with touch_ceases", wire.touch_motor._length, 1,
                                  kMaxTouchInputs);
    }
    for (const auto motor : elements(wire.touch_motor)) {
        check.within<std::size_t>("touch_motor", motor, 0, kMaxAxes - 1);
    }
    for (const auto channel : elements(wire.touch_channel)) {
        check.within<std::size_t>("touch_channel", channel, 0, kMostInputs - 1);
    }
}

void read_touch(const lockstep_wire_Setpoint& wire, TouchInputs& touch) {
    touch.any_of.clear();
    for (std::size_t i = 0; i < wire.touch_motor._length; ++i) {
        touch.any_of.append({MotorIndex{wire.touch_motor._buffer[i]}, wire.touch_channel._buffer[i]});
    }
    touch.opens = wire.touch_opens;
    touch.ceases = wire.touch_ceases;
}

void write_touch(const TouchInputs& touch, SetpointMessage& message) {
    SetpointMessage::Storage& storage = message.storage;
    storage.touch_motor.clear();
    storage.touch_channel.clear();
    for (const TouchInput& input : touch.any_of) {
        storage.touch_motor.push_back(static_cast<std::uint8_t>(input.motor));
        storage.touch_channel.push_back(input.channel);
    }
    show(message.touch_motor, storage.touch_motor);
    show(message.touch_channel, storage.touch_channel);
    message.touch_opens = touch.opens;
    message.touch_ceases = touch.ceases;
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
    write_touch(frame.touch, message);
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
    OutputWriter outputs(storage);
    for (const MotorOutputs& motor : frame.outputs) { outputs.append(motor); }
    show(message.output_motor, storage.output_motor);
    show(message.output_body_count, storage.output_body_count);
    show(message.output_tail_count, storage.output_tail_count);
    show(message.output_at, storage.output_at);
    show(message.output_channel, storage.output_channel);
    show(message.output_value, storage.output_value);
    show(message.output_slope, storage.output_slope);
}

FromWire<Frame> from_wire(const lockstep_wire_Setpoint& wire) {
    Frame frame;
    if (auto read = from_wire(wire, frame); !read) { return std::unexpected(std::move(read.error())); }
    return frame;
}

std::expected<void, std::string> from_wire(const lockstep_wire_Setpoint& wire, Frame& into) {
    Checks check("setpoint");
    check_shape(wire, check);
    if (check.passed()) { check_touch(wire, check); }
    if (check.passed()) { check_outputs(wire, check); }
    if (check.passed()) { check_values(wire, check); }
    if (!check.passed()) { return std::unexpected(check.refusal()); }
    into.term = {wire.term, wire.coordinator};
    into.epoch = wire.epoch;
    into.number = wire.number;
    into.start = {wire.start_tick};
    into.ticks = {wire.frame_ticks};
    into.last = wire.last;
    read_touch(wire, into.touch);
    into.axes.resize(wire.from_count._length);
    std::size_t at = 0;
    for (std::size_t i = 0; i < into.axes.size(); ++i) {
        AxisTrack& axis = into.axes[i];
        axis.from = Position::from_count(wire.from_count._buffer[i], wire.from_phase._buffer[i]);
        read_pieces(wire, at, wire.body_count._buffer[i], axis.body);
        read_pieces(wire, at, wire.tail_count._buffer[i], axis.tail);
    }
    read_outputs(wire, into.outputs);
    return {};
}

}  // namespace lockstep
