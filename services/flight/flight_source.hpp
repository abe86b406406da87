// The process that a flight record comes from, and its notes.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "core/flight/flight_event.hpp"

namespace lockstep {

struct FlightSource {
    std::string machine;
    std::string process;  // "coordinator" or "axis-NAME"
    Identity incarnation = 0;
    std::int64_t tick_ns = 1000;
    std::string config;               // content of machine.textproto
    std::filesystem::path directory;  // for incident files
    int files = 1;                    // number of incident files kept for this process, at least 1
    bool operator==(const FlightSource&) const = default;
};

struct NumberedEvent {
    std::uint64_t number = 0;  // from 1, without gaps, in the order noted
    FlightEvent event;
    bool operator==(const NumberedEvent&) const = default;
};

/// The content of a ring at one moment, in the order noted.
struct FlightSnapshot {
    FlightSource source;
    std::vector<NumberedEvent> events;
    std::string note;  // why the process ended itself; empty if it did not or could not note it
};

/// Returns the process name. `axis` is the axis's name in the machine's file, empty for the coordinator.
inline std::string flight_process(const std::string& axis) { return axis.empty() ? "coordinator" : "axis-" + axis; }

}  // namespace lockstep
