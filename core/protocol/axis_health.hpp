// Health figures of an axis, published ten times a second for people, plots and the record. No decision depends on
// them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/protocol/messages.hpp"
#include "core/protocol/process_counts.hpp"

namespace lockstep {

/// The least and the greatest of `count` values. Both are 0 if there are none.
struct Extremes {
    std::uint64_t count = 0;
    Ticks least;
    Ticks most;
    bool operator==(const Extremes&) const = default;

    void add(Ticks value) { merge({1, value, value}); }
    void merge(const Extremes& other) {
        if (other.count == 0) { return; }
        least = count == 0 ? other.least : std::min(least, other.least);
        most = count == 0 ? other.most : std::max(most, other.most);
        count += other.count;
    }
};

/// From the time at which a loop was due until its end.
struct LoopTime {
    Ticks p50;
    Ticks p99;
    Ticks most;
    bool operator==(const LoopTime&) const = default;
};

/// Counts since the process started.
struct RefusalCounts {
    std::uint64_t frames = 0;         // refused by the axis's own checks
    std::uint64_t commands = 0;       // the coordinator's, refused by the axis
    std::uint64_t messages = 0;       // refused when they were decoded
    std::uint64_t orders = 0;         // refused by the device, and failed reads of the device
    std::uint64_t captures = 0;       // step times lost because the capture ring was full (since the device's power-up)
    std::uint64_t records = 0;        // messages of the record that could not be sent
    std::uint64_t skipped_loops = 0;  // left out because their time had passed
    bool operator==(const RefusalCounts&) const = default;
};

struct AxisHealth {
    Identity identity = 0;
    std::uint32_t axis = 0;  // its place in the configuration
    Tick tick;               // machine time

    // The figures up to the blank line cover the last second.
    Extremes step_lateness;                 // device minus plan, in frames only; counted once the frame has been run
    Extremes step_interval;                 // between successive steps of a motion
    Extremes setpoint_slack;                // how long before its start a frame arrived
    std::uint32_t least_free_segments = 0;  // least room in the device's segment ring
    std::uint32_t least_free_captures = 0;  // least room in its capture ring

    LoopTime loop;                      // of the last thousand loops
    std::optional<Ticks> setpoint_age;  // since the newest frame arrived; empty while none is awaited
    Ticks clock_error;                  // bound on the error of its machine time
    RefusalCounts refused;
    RecordCounts published;  // record messages published by this process
    ProcessCounts process;
    bool operator==(const AxisHealth&) const = default;
};

}  // namespace lockstep
