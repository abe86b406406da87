// The outputs of a device: levels, analog values that change with each tick, and pulses at places.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/firmware/device/due.hpp"
#include "sim_fpga/firmware/device/events.hpp"
#include "sim_fpga/firmware/device/output_queue.hpp"
#include "sim_fpga/firmware/device/port.hpp"
#include "sim_fpga/firmware/device/ramp.hpp"
#include "sim_fpga/firmware/device/setup.hpp"

namespace lockstep::firmware {

class Outputs {
public:
    /// Both must outlive this object.
    Outputs(Events& events, Port& port) : events_(events), port_(port) {}

    void set(const Setup& setup, std::int64_t now);

    /// Begins a body or a tail after tick `start`. `changes`: in order; they must remain until the next call of begin
    /// or end.
    void begin(const OutputChange* changes, std::size_t count, std::int64_t start);
    /// The run ends after tick `now`, at this count: analog values stay as they are, and there are no more pulses.
    void end(std::int64_t now, std::int64_t count);

    /// The next tick at which something is due.
    Due next() const;
    /// Does what is due after tick `now`, at this count.
    void tend(std::int64_t now, std::int64_t count);
    /// Whether pulses are left to make.
    bool has_places() const { return places_.pulses != 0; }
    /// How many steps of a block from this count on arrive at the next place. 0: it is not among the first so many.
    std::uint32_t steps_to_place(const StepBlock& block, std::uint32_t steps, std::int64_t count) const;
    /// A step has arrived at the next place, at this count: a pulse begins.
    void arrive(std::int64_t tick, std::int64_t count);

    void change_digital(std::uint16_t levels, std::uint16_t mask, std::int64_t now, std::int64_t count);
    void change_analog(std::size_t channel, std::int64_t value, std::int64_t slope, std::int64_t now);
    void make_safe(const SafeOutputs& safe, std::int64_t now, std::int64_t count);

    /// Output n is bit n, 1 while it is on.
    std::uint16_t digital() const;
    /// Of the newest COMPARE: how many pulses were not made, so far or when it ended.
    std::uint32_t pulses_left() const { return pulses_left_; }
    /// What the output shows after tick `now`, from 0 to kFullScale.
    std::int64_t analog(std::size_t channel, std::int64_t now) const { return ramps_[channel].at(now); }

private:
    /// Pulses at places that are left to make.
    struct Places {
        std::int64_t next = 0;
        std::int32_t every = 0;
        std::uint32_t pulses = 0;
    };

    void show(std::int64_t now);
    void change(const OutputChange& change, std::int64_t now, std::int64_t count);
    void begin_places(const OutputChange& change, std::int64_t now, std::int64_t count);
    void end_places(std::int64_t now, std::int64_t count);

    Events& events_;
    Port& port_;
    const OutputChange* changes_ = nullptr;
    std::size_t left_ = 0;
    std::int64_t start_ = 0;

    std::uint16_t levels_ = 0;
    std::uint16_t shown_ = 0;  // to the port
    Ramp ramps_[kMostAnalog]{};

    std::uint16_t compare_outputs_ = 0;
    std::int64_t compare_ticks_ = 1;
    Places places_;
    std::uint32_t pulses_left_ = 0;
    Due pulse_ends_;
};

}  // namespace lockstep::firmware
