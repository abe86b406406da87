#include "services/wire/lcm/lcm_channels.hpp"

#include <array>
#include <utility>

namespace lockstep {
namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_upper(char c) { return c >= 'A' && c <= 'Z'; }
bool is_lower(char c) { return c >= 'a' && c <= 'z'; }

std::string upper(std::string_view name) {
    std::string out;
    for (const char c : name) {
        out += is_lower(c) ? static_cast<char>(c - 'a' + 'A') : is_upper(c) || is_digit(c) ? c : '_';
    }
    return out;
}

}  // namespace

AxisChannels channels_of(std::string_view machine, std::string_view axis) {
    const std::string stem = "LOCKSTEP_" + upper(machine) + "_" + upper(axis);
    return {.steps = stem + "_STEPS",
            .position = stem + "_POSITION",
            .run = stem + "_RUN",
            .health = stem + "_HEALTH",
            .channels = stem + "_CHANNELS"};
}

std::string job_channel(std::string_view machine) { return "LOCKSTEP_" + upper(machine) + "_JOB"; }

std::string event_channel(std::string_view machine) { return "LOCKSTEP_" + upper(machine) + "_EVENTS"; }

std::string loss_channel(std::string_view machine, std::string_view axis) {
    return "LOCKSTEP_" + upper(machine) + (axis.empty() ? "" : "_" + upper(axis)) + "_LOSS";
}

std::string mark_channel(std::string_view machine, std::string_view axis) {
    return "LOCKSTEP_" + upper(machine) + (axis.empty() ? "" : "_" + upper(axis)) + "_MARK";
}

std::string program_channel(std::string_view machine) { return "LOCKSTEP_" + upper(machine) + "_PROGRAM"; }

std::string flight_channel(std::string_view machine, std::string_view process) {
    return "LOCKSTEP_" + upper(machine) + "_" + upper(process) + "_FLIGHT";
}

RecordKind kind_of(std::string_view channel) {
    constexpr std::array<std::pair<std::string_view, RecordKind>, 10> kEnds{{{"_STEPS", RecordKind::Steps},
                                                                             {"_POSITION", RecordKind::Position},
                                                                             {"_HEALTH", RecordKind::Health},
                                                                             {"_RUN", RecordKind::Run},
                                                                             {"_CHANNELS", RecordKind::Channels},
                                                                             {"_JOB", RecordKind::Job},
                                                                             {"_EVENTS", RecordKind::Event},
                                                                             {"_PROGRAM", RecordKind::ProgramPart},
                                                                             {"_LOSS", RecordKind::Loss},
                                                                             {"_MARK", RecordKind::Mark}}};
    if (!channel.starts_with("LOCKSTEP_")) { return RecordKind::Foreign; }
    for (const auto& [end, kind] : kEnds) {
        if (channel.ends_with(end)) { return kind; }
    }
    return RecordKind::Foreign;
}

}  // namespace lockstep
