// All that a server knows of its machine at one time, as values.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/web/measuring/measurement.hpp"
#include "core/protocol/axis_health.hpp"
#include "core/protocol/messages.hpp"
#include "services/documents/values/values_document.hpp"

namespace lockstep::web {

using std::chrono::nanoseconds;

template <typename Value>
struct Seen {
    Value value;
    nanoseconds time;  // CLOCK_MONOTONIC of this host
};

/// Of an axis, or of a motor.
struct AxisSnapshot {
    bool is_present = false;
    bool is_process = true;     // false: an axis without a motor of its own, whose motors are in Snapshot::motors
    double steps_per_tick = 0;  // its speed
    std::optional<Seen<AxisState>> state;
    std::optional<Seen<AxisHealth>> health;
};

/// A motor that is not the only one of an axis, or a board.
struct MotorSnapshot {
    std::string name;
    bool is_board = false;
    std::vector<std::string> axes;  // that it moves
    double steps_per_mm = 1;
    AxisSnapshot seen;
};

/// A motor at rest that is not where the other motors of its axes place it.
struct MotorApart {
    std::string name;
    double off_mm = 0;
};

/// The server's knowledge of a program that it loads.
struct ProgramFacts {
    std::uint64_t id = 0;  // 0 for a line of mdi
    std::string name;
    std::size_t bytes = 0;
    std::size_t lines = 0;
    std::vector<std::int32_t> block_lines;  // the line of each block; 0: none
    bool rises = true;                      // block_lines never falls: the program repeats nothing
    struct Note {
        std::int32_t line = 0;
        std::string text;
    };
    std::vector<Note> notes;
};

/// A job of a program that this server sent.
struct OwnJob {
    std::uint64_t number = 0;
    std::shared_ptr<const ProgramFacts> program;
};

/// The client that gives the machine its commands.
struct Writer {
    std::string name;
    std::string host;
    std::chrono::system_clock::time_point since;
    bool is_this_server = false;
};

/// The modes with which the next line of mdi begins.
struct LineModes {
    std::vector<std::string> words;  // "G0", "G54" and so on
    std::size_t system = 0;          // 0 is G54
};

struct Snapshot {
    nanoseconds time{};  // when it was taken
    std::optional<Seen<MachineState>> machine;
    bool is_silent = true;  // no coordinator is received
    bool has_standby = false;
    bool config_differs = false;
    std::vector<AxisSnapshot> axes;  // in the order of the configuration
    std::vector<MotorSnapshot> motors;
    std::optional<MotorApart> apart;
    std::optional<RevisedValues> values;
    std::optional<nanoseconds> values_unsaved_since;  // not on the coordinator's disk since then; none: they are
    std::optional<OwnJob> job;
    std::optional<Writer> writer;
    std::optional<Measurement> measurement;  // the newest of this server
};

}  // namespace lockstep::web
