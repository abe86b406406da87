// How well an axis is doing, said ten times a second: for people, plots and the record. Nobody decides by it.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>

#include "core/protocol/messages.hpp"
#include "core/protocol/process_counts.hpp"

namespace lockstep {

/// The least and the most of so many values; both are 0 where there were none.
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

/// From when a loop was to begin until it was done.
struct LoopTime {
    Ticks p50;
    Ticks p99;
    Ticks most;
    bool operator==(const LoopTime&) const = default;
};

/// Since the process started.
struct RefusalCounts {
    std::uint64_t frames = 0;         // by the axis's own checks
    std::uint64_t commands = 0;       // of the coordinator
    std::uint64_t messages = 0;       // that could not be believed, before they were looked at
    std::uint64_t orders = 0;         // by the device, or looks at it that failed
    std::uint64_t captures = 0;       // steps whose time found the capture ring full (since the device's power-up)
    std::uint64_t records = 0;        // messages of the record that could not be sent
    std::uint64_t skipped_loops = 0;  // whose time had passed
    bool operator==(const RefusalCounts&) const = default;
};

struct AxisHealth {
    Identity identity = 0;
    std::uint32_t axis = 0;  // its place in the configuration
    Tick tick;               // machine time

    // Of the second before, as all that follows to the next line.
    Extremes step_lateness;                 // device against plan, in frames; as soon as the frame has been run
    Extremes step_interval;                 // between steps of a motion
    Extremes setpoint_slack;                // how long before its start a frame came
    std::uint32_t least_free_segments = 0;  // room in the device's segment ring
    std::uint32_t least_free_captures = 0;  // room in its capture ring

    LoopTime loop;                      // of the last thousand loops
    std::optional<Ticks> setpoint_age;  // since the newest frame came; nothing where none is awaited
    Ticks clock_error;                  // its machine time is at most so far off
    RefusalCounts refused;
    RecordCounts published;  // of the record, by this process
    ProcessCounts process;
    bool operator==(const AxisHealth&) const = default;
};

}  // namespace lockstep
