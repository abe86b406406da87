// Translates core's values to messages of the record (idl/lcm).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <lockstep/axis_health_t.hpp>
#include <lockstep/axis_position_t.hpp>
#include <lockstep/channel_event_t.hpp>
#include <lockstep/job_t.hpp>
#include <lockstep/program_event_t.hpp>
#include <lockstep/record_mark2_t.hpp>
#include <lockstep/run_t.hpp>

#include "core/clock/clock_view.hpp"
#include "core/hardware/output_change.hpp"
#include "core/machine.hpp"
#include "core/protocol/axis_health.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// Microseconds of machine time.
std::int64_t utime_of(Tick machine, std::int64_t tick_ns);

/// Identifies a message of a channel: the process that recorded it, and a number without gaps.
struct RecordNumber {
    Identity incarnation = 0;
    std::uint64_t sequence = 0;
};

/// The position of an axis. state.axis is an index into the machine's axes.
axis_position_t to_lcm(const MachineConfig& machine, const AxisState& state, RecordNumber number);

/// The health of an axis. health.axis is an index into the machine's axes.
axis_health_t to_lcm(const MachineConfig& machine, const AxisHealth& health, RecordNumber number);

/// A change of an input or an output of an axis's device.
struct ChannelRecord {
    RecordNumber number;
    std::uint64_t lost = 0;       // changes that the device has lost so far
    std::int64_t zero_count = 0;  // machine coordinates = device count - zero_count
    ClockView clock;              // the device's clock in machine time, now
    ChannelEvent event;
};

/// Writes all fields but the names of machine and axis into a reused message.
void to_lcm(const ChannelRecord& record, std::int64_t tick_ns, channel_event_t& out);

/// Returns the change that the message reports; nullopt if its kind is unknown or a number is beyond its range.
std::optional<ChannelEvent> event_of(const channel_event_t& message);

/// Returns the name as in channel_event_t, such as "compare-begins".
std::string_view name_of(ChannelEvent::Kind kind);

/// One frame or tail that an axis's device has run.
struct RunRecord {
    std::string machine;
    std::string axis;
    Identity incarnation = 0;
    std::uint64_t sequence = 0;  // runs and tails are numbered without gaps
    Epoch epoch = 0;             // 0: the axis's own move
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Position from;                             // machine coordinates
    std::optional<std::int64_t> cut_at_steps;  // where pulses ceased early; nullopt: the pieces ran completely
    std::int64_t zero_count = 0;               // machine coordinates = device count - zero_count
    std::span<const Piece> pieces;
    Ticks ahead;                             // the commanded start in machine time, minus `start`
    std::span<const Ticks> commanded_ticks;  // of each piece; empty: as in `pieces`
    Ticks clock_error;
};

run_t to_lcm(const RunRecord& record, std::int64_t tick_ns);
/// Does the same into a reused message.
void to_lcm(const RunRecord& record, std::int64_t tick_ns, run_t& out);

/// The published counts of a process at one time. An empty process name means a coordinator.
struct RecordMark {
    std::string machine;
    std::string witness;
    std::string process;
    Identity incarnation = 0;  // of the process
    RecordCounts counts;
    bool ended = false;
};

record_mark2_t to_lcm(const RecordMark& mark, Tick then, std::int64_t tick_ns);

/// An event of a job: it began, continues in a new epoch, got new overrides, or ended. The fields are those of job_t.
struct JobRecord {
    std::string machine;
    Identity coordinator = 0;
    std::uint64_t sequence = 0;  // without gaps, shared with the events of programs
    std::uint64_t job = 0;
    std::string kind;
    std::string event;
    std::string outcome;
    Epoch epoch = 0;
    Tick start;
    std::int64_t resume_block = 0;
    Int128 resume_along = 0;  // along that block's path
    FrameNumber behind_frame = 0;
    Overrides overrides;
    std::string config;
    std::string program;                    // of a probe: the name of the input that touched first
    std::vector<std::int64_t> start_count;  // of a probe: nm, or millionths of a degree
};
inline constexpr double kNmInMm = 1e6;

job_t to_lcm(const JobRecord& record, Tick now, std::int64_t tick_ns);

/// An event of a program. Its number is from the same sequence as those of job events.
struct EventRecord {
    std::string machine;
    RecordNumber number;
    PublishedEvent event;
};

program_event_t to_lcm(const EventRecord& record, Tick now, std::int64_t tick_ns);

/// Returns the event that the message reports; nullopt if its kind is unknown or its value is not finite.
std::optional<ProgramEvent> event_of(const program_event_t& message);

}  // namespace lockstep
