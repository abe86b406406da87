// Changes of a device's outputs in step with motion. They travel in the frames of the device that has the outputs.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "core/static_vector.hpp"
#include "core/units.hpp"

namespace lockstep {

/// The greatest numbers that the register map has room for (sim_fpga/registers.json).
inline constexpr std::size_t kMostDigitalOutputs = 16;
inline constexpr std::size_t kMostAnalogOutputs = 8;
inline constexpr std::size_t kMostInputs = 32;

/// Full scale of an analog output. Its value is a whole number of 2^-62 of this.
inline constexpr std::int64_t kFullScale = std::int64_t{1} << 62;

/// The values of a device's analog outputs, by channel, as it reports them: in 2^-15 of full scale.
using AnalogLevels = std::array<std::uint16_t, kMostAnalogOutputs>;
inline constexpr std::uint16_t kFullAnalogLevel = std::uint16_t{1} << 15;
constexpr std::uint16_t analog_level(std::int64_t value) { return static_cast<std::uint16_t>(value >> 47); }
static_assert(analog_level(kFullScale) == kFullAnalogLevel);

/// The outputs in `mask` get their levels of `levels`. Output n is bit n.
struct SetDigital {
    std::uint16_t levels = 0;
    std::uint16_t mask = 0;
    bool operator==(const SetDigital&) const = default;
};

/// From this tick on the output has this value, plus `slope` for each tick after. It stays at 0 and at full scale when
/// it gets there.
struct RampAnalog {
    std::uint8_t channel = 0;
    std::int64_t value = 0;
    std::int64_t slope = 0;  // for each tick
    bool operator==(const RampAnalog&) const = default;
};

/// From this tick on, each step that arrives at the next place makes a pulse: at the count `next`, then at counts
/// `every` steps apart, until there were so many pulses. With 0 pulses there are no more.
struct ComparePosition {
    std::int64_t next = 0;
    std::int32_t every = 0;  // signed: the direction in which the next place lies
    std::uint32_t pulses = 0;
    bool operator==(const ComparePosition&) const = default;
};

struct OutputChange {
    Ticks at;  // after the start of the frame's body or tail; at least 1
    std::variant<SetDigital, RampAnalog, ComparePosition> what;
    bool operator==(const OutputChange&) const = default;
};

/// The changes of a frame, each list by rising ticks. Those of the tail happen if the tail is run.
struct OutputTrack {
    static constexpr std::size_t kMostInBody = 192;
    static constexpr std::size_t kMostInTail = 64;
    StaticVector<OutputChange, kMostInBody> body;
    StaticVector<OutputChange, kMostInTail> tail;

    std::size_t size() const { return body.size() + tail.size(); }
    bool empty() const { return size() == 0; }
    bool operator==(const OutputTrack&) const = default;
};

/// Something that happened at an input or an output of a device, with the tick at which it happened.
struct ChannelEvent {
    enum class Kind : std::uint8_t { Input, Digital, Analog, CompareBegins, CompareEnds };
    Tick tick;
    Kind kind = Kind::Input;
    std::uint8_t channel = 0;  // of an input or an analog output
    bool closed = false;       // Input
    std::uint16_t levels = 0;  // Digital: of all outputs, from now on
    std::int64_t value = 0;    // Input and Compare: the count at this tick. Analog: the value
    std::int64_t detail = 0;   // Input: the phase. Analog: the slope. Compare: pulses to make, or not made
    bool operator==(const ChannelEvent&) const = default;

    static constexpr bool is_of_pulses(Kind kind) { return kind == Kind::CompareBegins || kind == Kind::CompareEnds; }
};

}  // namespace lockstep
