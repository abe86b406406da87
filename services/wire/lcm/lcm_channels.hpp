// The names of the LCM channels of a machine's record.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lockstep {

/// LOCKSTEP_<MACHINE>_<AXIS>_..., upper-cased; characters other than letters and digits become '_', since LCM
/// subscribes by regular expression. LCM truncates names to 63 bytes, so the machine's and axis's names
/// must be short enough.
struct AxisChannels {
    std::string steps;
    std::string position;
    std::string run;
    std::string health;
    std::string channels;  // of the device: its inputs and outputs
};

AxisChannels channels_of(std::string_view machine, std::string_view axis);
std::string job_channel(std::string_view machine);
/// The channel of programs' events.
std::string event_channel(std::string_view machine);
/// The channel of loss messages in a log. `axis` is empty for the coordinator.
std::string loss_channel(std::string_view machine, std::string_view axis);

/// The channel of a process's published counts; `axis` is empty for a coordinator.
std::string mark_channel(std::string_view machine, std::string_view axis);
/// The channel of program parts, for programs too long for a job's message.
std::string program_channel(std::string_view machine);

/// The channel of incident files. `process` is "coordinator" or "axis-NAME".
std::string flight_channel(std::string_view machine, std::string_view process);

/// The kind of a channel's messages, from its name.
enum class RecordKind : std::uint8_t {
    Steps,
    Position,
    Health,
    Run,
    Channels,
    Job,
    Event,
    ProgramPart,
    Loss,
    Mark,
    Foreign
};
RecordKind kind_of(std::string_view channel);

/// Returns the kind that shares its sequence numbers with this one: events are numbered together with jobs.
constexpr RecordKind numbered_with(RecordKind kind) { return kind == RecordKind::Event ? RecordKind::Job : kind; }

}  // namespace lockstep
