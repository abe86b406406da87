// Messages with random contents, all of which the wire must carry.
#pragma once

#include <random>

#include "core/protocol/axis_health.hpp"
#include "core/protocol/machine_values.hpp"

namespace lockstep {

class RandomMessages {
public:
    explicit RandomMessages(std::uint64_t seed) : random_(seed) {}

    Frame frame();
    AxisState axis_state();
    AxisHealth axis_health();
    AxisCommand axis_command();
    ClockRequest clock_request();
    ClockReply clock_reply();
    MachineState machine_state();
    StaticVector<FrameRest, kMaxRests> rests();
    StaticVector<std::int64_t, kMaxAxes> places();
    MachinePause pause();
    ProbeResult probe();
    LeaseHolder writer();
    std::vector<JogAxis> jogs();
    Command command();
    ProgramChunk chunk();
    Reply reply();
    PublishedEvent event();
    ProgramDevices devices();
    MachineValues machine_values();

    std::uint64_t bits() { return random_(); }
    std::int64_t between(std::int64_t least, std::int64_t most) {
        return std::uniform_int_distribution<std::int64_t>(least, most)(random_);
    }
    std::uint32_t index(std::size_t count) {
        return static_cast<std::uint32_t>(between(0, static_cast<std::int64_t>(count) - 1));
    }

private:
    std::int64_t far() { return between(-(std::int64_t{1} << 62), std::int64_t{1} << 62); }
    std::int64_t rate() { return between(-INT64_MAX, INT64_MAX); }
    FaultCode fault() { return static_cast<FaultCode>(bits()); }
    Term term() { return {bits(), bits()}; }
    AnalogLevels analog_levels() {
        AnalogLevels levels;
        for (std::uint16_t& level : levels) { level = static_cast<std::uint16_t>(index(kFullAnalogLevel + 1)); }
        return levels;
    }
    Extremes extremes() { return {bits(), {far()}, {far()}}; }
    bool coin() { return bits() % 2 == 1; }
    Position position() { return Position::from_count(far(), bits()); }
    template <typename T>
    std::optional<T> maybe(const T& value) {
        return coin() ? std::optional(value) : std::nullopt;
    }
    Piece piece() { return {{between(0, INT32_MAX)}, {rate()}, {rate()}}; }

    std::mt19937_64 random_;
};

}  // namespace lockstep
