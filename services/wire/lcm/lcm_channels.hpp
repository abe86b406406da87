// The names of the LCM channels: all that a machine records.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace lockstep {

/// LOCKSTEP_<MACHINE>_<AXIS>_..., upper-cased; what is no letter or digit becomes '_', since LCM subscribes by regular
/// expression. LCM cuts names off at kMaxChannelName bytes: shorten the machine's or the axis's name before.
struct AxisChannels {
    std::string steps;
    std::string position;
    std::string run;
    std::string health;
};

inline constexpr std::size_t kMaxChannelName = 63;

AxisChannels channels_of(std::string_view machine, std::string_view axis);
std::string job_channel(std::string_view machine);
/// Where a log says what it lacks. `axis` is empty for the coordinator's.
std::string loss_channel(std::string_view machine, std::string_view axis);

/// Where it is said how much a process has published; `axis` is empty for a coordinator.
std::string mark_channel(std::string_view machine, std::string_view axis);
/// Parts of programs that are too long for a job's message.
std::string program_channel(std::string_view machine);

/// Of incident files. `process`: coordinator, axis-NAME.
std::string flight_channel(std::string_view machine, std::string_view process);

/// What a channel's messages are, by its name.
enum class RecordKind : std::uint8_t { Steps, Position, Health, Run, Job, ProgramPart, Loss, Mark, Foreign };
RecordKind kind_of(std::string_view channel);

}  // namespace lockstep
