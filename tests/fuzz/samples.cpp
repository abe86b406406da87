// Samples with any bytes in their fields: each is refused with a text, or its value in core goes to the wire and back
// unchanged. The lengths of sequences match their memory, as the middleware guarantees; all else is arbitrary.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>
#include <vector>

#include "services/wire/translate/translate.hpp"
#include "tests/fuzz/require.hpp"

namespace lockstep {
namespace {

class Bytes {
public:
    explicit Bytes(std::span<const std::uint8_t> data) : left_(data) {}

    /// Missing bytes are zeros.
    template <typename T>
    T take() {
        static_assert(std::is_trivially_copyable_v<T>);
        T value{};
        const std::size_t size = std::min(sizeof value, left_.size());
        std::memcpy(static_cast<void*>(&value), left_.data(), size);
        left_ = left_.subspan(size);
        return value;
    }
    template <typename T>
    std::vector<T> take_some(std::size_t most) {
        std::vector<T> values(take<std::uint8_t>() % (most + 1));
        for (T& value : values) { value = take<T>(); }
        return values;
    }

private:
    std::span<const std::uint8_t> left_;
};

/// The middleware delivers a boolean only as 0 or 1.
void settle(bool& flag) {
    std::uint8_t byte = 0;
    std::memcpy(&byte, &flag, 1);
    flag = (byte & 1U) != 0;
}

template <typename Sequence, typename T>
void show(Sequence& sequence, std::vector<T>& items) {
    sequence._buffer = items.data();
    sequence._length = sequence._maximum = static_cast<std::uint32_t>(items.size());
    sequence._release = false;
}

template <typename Wire>
void check(const Wire& wire) {
    const auto value = from_wire(wire);
    if (!value) { return require(!value.error().empty(), "a refusal has a text"); }
    const auto message = to_wire(*value);
    const auto again = from_wire(static_cast<const Wire&>(message));
    require(again.has_value(), "what was accepted once is accepted again");
    require(*again == *value, "what was accepted goes to the wire and back unchanged");
}

void check_setpoint(Bytes& bytes) {
    auto wire = bytes.take<lockstep_wire_Setpoint>();
    settle(wire.last);
    auto counts = bytes.take_some<std::int64_t>(kMaxAxes + 1);
    auto phases = bytes.take_some<std::uint64_t>(kMaxAxes + 1);
    auto bodies = bytes.take_some<std::uint16_t>(kMaxAxes + 1);
    auto tails = bytes.take_some<std::uint16_t>(kMaxAxes + 1);
    auto ticks = bytes.take_some<std::int64_t>(255);
    auto velocities = bytes.take_some<std::int64_t>(255);
    auto accelerations = bytes.take_some<std::int64_t>(255);
    show(wire.from_count, counts);
    show(wire.from_phase, phases);
    show(wire.body_count, bodies);
    show(wire.tail_count, tails);
    show(wire.ticks, ticks);
    show(wire.velocity, velocities);
    show(wire.acceleration, accelerations);
    check(wire);
}

void check_machine_state(Bytes& bytes) {
    auto wire = bytes.take<lockstep_wire_MachineState>();
    for (bool* flag : {&wire.has_veto, &wire.has_outcome, &wire.is_run}) { settle(*flag); }
    auto rests = bytes.take_some<lockstep_wire_FrameRest>(lockstep_wire_MAX_RESTS + 1);
    for (auto& rest : rests) { settle(rest.last); }
    show(wire.rests, rests);
    check(wire);
}

void check_axis_state(Bytes& bytes) {
    auto wire = bytes.take<lockstep_wire_AxisState>();
    for (bool* flag : {&wire.has_veto, &wire.at_rest, &wire.homed, &wire.hears_owner}) { settle(*flag); }
    check(wire);
}

void check_health(Bytes& bytes) {
    auto wire = bytes.take<lockstep_wire_AxisHealth>();
    settle(wire.has_setpoint_age);
    (void)from_wire(wire);
}

void check_command(Bytes& bytes) {
    auto wire = bytes.take<lockstep_wire_Command>();
    auto jogs = bytes.take_some<lockstep_wire_JogAxis>(lockstep_wire_MAX_JOGS + 1);
    show(wire.jogs, jogs);
    check(wire);
}

void check_chunk(Bytes& bytes) {
    auto wire = bytes.take<lockstep_wire_ProgramChunk>();
    auto content = bytes.take_some<std::uint8_t>(255);
    show(wire.bytes, content);
    check(wire);
}

void check_reply(Bytes& bytes) {
    auto wire = bytes.take<lockstep_wire_Reply>();
    wire.text[sizeof wire.text - 1] = '\0';
    (void)from_wire(wire);
}

}  // namespace
}  // namespace lockstep

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep;
    Bytes bytes({data, size});
    switch (bytes.take<std::uint8_t>() % 10) {
        case 0: check_setpoint(bytes); break;
        case 1: check_machine_state(bytes); break;
        case 2: check_axis_state(bytes); break;
        case 3: check_health(bytes); break;
        case 4: check_chunk(bytes); break;
        case 5: check_reply(bytes); break;
        case 6: check(bytes.take<lockstep_wire_AxisCommand>()); break;
        case 7: check(bytes.take<lockstep_wire_ClockRequest>()); break;
        case 8: check(bytes.take<lockstep_wire_ClockReply>()); break;
        default: check_command(bytes); break;
    }
    return 0;
}
