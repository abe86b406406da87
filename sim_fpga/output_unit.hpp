// The outputs of a device: levels, analog values that change with each tick, and pulses at places.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "core/hardware/device_setup.hpp"
#include "core/hardware/output_change.hpp"
#include "sim_fpga/event_ring.hpp"

namespace lockstep {

class OutputUnit {
public:
    /// `events` must outlive this object.
    explicit OutputUnit(EventRing& events) : events_(events) {}

    void set(const DeviceSetup& setup);

    /// Begins a body or a tail after tick `start`. `changes`: in order; they must remain until the next call of begin
    /// or end.
    void begin(const OutputChange* changes, std::size_t count, Tick start);
    /// The run ends after tick `now`, at this count: analog values stay as they are, and there are no more pulses.
    void end(Tick now, std::int64_t count);

    /// The next tick at which something is due; nullopt if nothing is.
    std::optional<Tick> next() const;
    /// Does what is due after tick `now`, at this count.
    void tend(Tick now, std::int64_t count);
    /// A step that arrives at this count.
    void arrive(Tick tick, std::int64_t count);

    void change(const SetDigital& digital, Tick now, std::int64_t count);
    void change(const RampAnalog& analog, Tick now, std::int64_t count);
    void make_safe(const SafeOutputs& safe, Tick now, std::int64_t count);

    /// Output n is bit n, 1 while it is on.
    std::uint16_t digital() const;
    /// Of the newest COMPARE: how many pulses were not made, so far or when it ended.
    std::uint32_t pulses_left() const { return pulses_left_; }
    /// What the output shows after tick `now`, from 0 to kFullScale.
    std::int64_t analog(std::size_t channel, Tick now) const;
    AnalogLevels analog(Tick now) const;

private:
    /// A value that changes by its slope with each tick, and stays at 0 or full scale when it gets there.
    struct Ramp {
        std::int64_t value = 0;
        std::int64_t slope = 0;
        Tick since;
        std::int64_t at(Tick now) const;
    };

    void change(const ComparePosition& compare, Tick now, std::int64_t count);
    void end_compare(Tick now, std::int64_t count);

    EventRing& events_;
    const OutputChange* changes_ = nullptr;
    std::size_t left_ = 0;
    Tick start_;

    std::uint16_t levels_ = 0;
    std::array<Ramp, kMostAnalogOutputs> ramps_{};

    std::uint16_t compare_outputs_ = 0;
    Ticks compare_pulse_{1};
    ComparePosition compare_;
    std::uint32_t pulses_left_ = 0;
    std::optional<Tick> pulse_ends_;
};

}  // namespace lockstep
