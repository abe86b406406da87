// The names of the LCM channels: all that a machine records.
#pragma once

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

}  // namespace lockstep
