#include "clients/analysis/channels/channel_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "services/record/reading/log_step.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::analysis {
namespace {

using ChannelKind = ChannelEvent::Kind;

const char* kind_text(ChannelKind kind) {
    if (kind == ChannelKind::Input) { return "input"; }
    if (kind == ChannelKind::Analog) { return "analog output"; }
    return kind == ChannelKind::Digital ? "digital output" : "pulses at places, output";
}

std::string value_text(const ChannelChange& change) {
    if (change.kind == ChannelKind::Analog) { return fmt::format("{:.4g} %", change.value * 100); }
    if (change.kind == ChannelKind::CompareBegins) {
        return fmt::format("begins, {:.0f} pulses to make", change.value);
    }
    if (change.kind == ChannelKind::CompareEnds) {
        return change.value == 0 ? "has made all pulses" : fmt::format("ends, {:.0f} pulses not made", change.value);
    }
    const bool is_one = change.value > 0;
    return change.kind == ChannelKind::Input ? (is_one ? "closed" : "open") : (is_one ? "on" : "off");
}

bool is_of_board(const ChannelChange& change, const MachineConfig* machine) {
    const auto is_it = [&](const BoardConfig& board) { return board.name == change.motor; };
    return machine != nullptr && std::ranges::any_of(machine->boards, is_it);
}

}  // namespace

void ChannelLog::take(const channel_event_t& message) {
    if (!event_of(message) || !is_countable(message.tick) || !is_countable(message.ahead)) { return; }
    devices_[message.axis].stream.take(message,
                                       [this](const channel_event_t& next, Before before) { follow(next, before); });
}

void ChannelLog::follow(const channel_event_t& message, Before before) {
    const auto event = event_of(message);
    Device& device = devices_[message.axis];
    const bool lost_some = device.lost && *device.lost != message.lost;
    if (before != Before::Nothing || lost_some) { lose(device); }
    device.lost = message.lost;
    ChannelChange change{.at = {message.tick + message.ahead}, .motor = message.axis, .kind = event->kind};
    device.newest = std::max(device.newest, change.at);
    change.channel = event->channel;
    if (event->kind == ChannelKind::Input) {
        change.value = event->closed ? 1 : 0;
        course_of(device, change).change({change.at, change.value, 0});
        note(change);
    } else if (event->kind == ChannelKind::Analog) {
        constexpr auto kScale = static_cast<double>(kFullScale);
        change.value = static_cast<double>(event->value) / kScale;
        course_of(device, change).change({change.at, change.value, static_cast<double>(event->detail) / kScale});
        note(change);
    } else if (event->kind == ChannelKind::Digital) {
        follow_levels(device, change, event->levels);
    } else {
        change.value = static_cast<double>(event->detail);
        note(change);
    }
}

/// A message has the levels of all outputs, so that after a gap those of all are known again.
void ChannelLog::follow_levels(Device& device, const ChannelChange& change, std::uint16_t levels) {
    const auto changed = static_cast<unsigned>(std::exchange(device.levels, levels) ^ levels);
    if (!device.levels_from) { device.levels_from = change.at; }
    for (std::size_t i = 0; i < kMostDigitalOutputs; ++i) {
        ChannelChange of = change;
        of.channel = static_cast<int>(i);
        of.value = (levels >> i & 1) != 0 ? 1 : 0;
        const bool has_changed = (changed >> i & 1U) != 0;
        const bool is_new = !device.courses.contains({of.kind, of.channel});
        const bool was_known = has_changed && is_new && *device.levels_from < of.at;
        if (was_known) { course_of(device, of).change({*device.levels_from, 1 - of.value, 0}); }
        if (has_changed || !is_new) { course_of(device, of).change({of.at, of.value, 0}); }
        if (has_changed) { note(of); }
    }
}

/// The log has all of the device's changes until the newest one.
void ChannelLog::lose(Device& device) {
    for (auto& [channel, course] : device.courses) { course.lose(device.newest); }
    device.levels_from.reset();
}

ChannelCourse& ChannelLog::course_of(Device& device, const ChannelChange& change) {
    return device.courses
        .try_emplace({change.kind, change.channel}, ChannelCourse(change.motor, change.kind, change.channel))
        .first->second;
}

void ChannelLog::note(ChannelChange change) {
    if (changes_.size() == kChangesKept) {
        ++not_kept_;
        return;
    }
    changes_.push_back(std::move(change));
}

void ChannelLog::finish(Tick end) {
    for (auto& [motor, device] : devices_) {
        device.stream.finish([this](const channel_event_t& next, Before before) { follow(next, before); });
        for (auto& [channel, course] : device.courses) { course.finish(end); }
    }
    std::ranges::stable_sort(changes_, {}, &ChannelChange::at);
}

std::vector<ChannelCourse> ChannelLog::courses() {
    std::vector<ChannelCourse> all;
    for (auto& [motor, device] : devices_) {
        for (auto& [channel, course] : device.courses) { all.push_back(std::move(course)); }
    }
    return all;
}

/// A device has one output that makes pulses; their events have no channel.
const OutputConfig* output_of(const ChannelChange& change, const MachineConfig& machine) {
    if (change.kind == ChannelKind::Input) { return nullptr; }
    const auto output = std::ranges::find_if(machine.outputs, [&](const OutputConfig& config) {
        if (config.motor != change.motor) { return false; }
        if (ChannelEvent::is_of_pulses(change.kind)) { return config.makes_pulses(); }
        return config.channel == change.channel && config.is_analog() == (change.kind == ChannelKind::Analog);
    });
    return output == machine.outputs.end() ? nullptr : &*output;
}

std::optional<std::string> name_of(const ChannelChange& change, const MachineConfig& machine) {
    if (change.kind == ChannelKind::Input) {
        const auto input = std::ranges::find_if(machine.inputs, [&](const InputConfig& config) {
            return config.motor == change.motor && config.channel == change.channel;
        });
        return input == machine.inputs.end() ? std::nullopt : std::optional(input->name);
    }
    const OutputConfig* const output = output_of(change, machine);
    return output == nullptr ? std::nullopt : std::optional(output->name);
}

std::string channel_text(const ChannelChange& change, const MachineConfig* machine) {
    constexpr std::array kSwitches{"lower limit switch", "upper limit switch", "home switch"};
    static_assert(kSwitches.size() == kSwitchInputs);
    if (const auto name = machine != nullptr ? name_of(change, *machine) : std::nullopt) { return *name; }
    const bool is_switch = change.kind == ChannelKind::Input && change.channel < kSwitchInputs;
    if (is_switch && !is_of_board(change, machine)) { return kSwitches[static_cast<std::size_t>(change.channel)]; }
    return fmt::format("{} {}", kind_text(change.kind), change.channel);
}

std::string change_text(const ChannelChange& change, const MachineConfig* machine) {
    return channel_text(change, machine) + " " + value_text(change);
}

}  // namespace lockstep::analysis
