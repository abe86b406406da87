#include "clients/analysis/channels/channel_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "services/record/reading/message_numbers.hpp"
#include "services/wire/lcm/translate_lcm.hpp"

namespace lockstep::analysis {
namespace {

using ChannelKind = ChannelEvent::Kind;

const char* kind_text(ChannelKind kind) {
    if (kind == ChannelKind::Input) { return "input"; }
    return kind == ChannelKind::Analog ? "analog output" : "digital output";
}

std::string value_text(const ChannelChange& change) {
    if (change.kind == ChannelKind::Analog) { return fmt::format("{:.4g} %", change.value * 100); }
    const bool is_one = change.value > 0;
    return change.kind == ChannelKind::Input ? (is_one ? "closed" : "open") : (is_one ? "on" : "off");
}

}  // namespace

void ChannelLog::take(const channel_event_t& message) {
    if (!event_of(message) || !is_countable(message.tick) || !is_countable(message.ahead)) { return; }
    streams_[message.axis].take(message, [this](const channel_event_t& next, Before) { follow(next); });
}

void ChannelLog::follow(const channel_event_t& message) {
    const auto event = event_of(message);
    ChannelChange change{.at = {message.tick + message.ahead}, .motor = message.axis, .kind = event->kind};
    change.channel = event->channel;
    if (event->kind == ChannelKind::Input) {
        change.value = event->closed ? 1 : 0;
        note(change);
    } else if (event->kind == ChannelKind::Analog) {
        change.value = static_cast<double>(event->value) / static_cast<double>(kFullScale);
        note(change);
    } else if (event->kind == ChannelKind::Digital) {
        const auto changed = static_cast<unsigned>(std::exchange(levels_[message.axis], event->levels) ^ event->levels);
        for (std::size_t i = 0; i < kMostDigitalOutputs; ++i) {
            if ((changed >> i & 1U) == 0) { continue; }
            change.channel = static_cast<int>(i);
            change.value = (event->levels >> i & 1) != 0 ? 1 : 0;
            note(change);
        }
    }
}

void ChannelLog::note(ChannelChange change) {
    if (changes_.size() == kChangesKept) {
        ++not_kept_;
        return;
    }
    changes_.push_back(std::move(change));
}

std::vector<ChannelChange> ChannelLog::finish() {
    for (auto& [motor, stream] : streams_) {
        stream.finish([this](const channel_event_t& next, Before) { follow(next); });
    }
    std::ranges::stable_sort(changes_, {}, &ChannelChange::at);
    return std::move(changes_);
}

std::optional<std::string> name_of(const ChannelChange& change, const MachineConfig& machine) {
    const auto is_it = [&](const auto& config) {
        return config.motor == change.motor && config.channel == change.channel;
    };
    if (change.kind == ChannelKind::Input) {
        const auto input = std::ranges::find_if(machine.inputs, is_it);
        return input == machine.inputs.end() ? std::nullopt : std::optional(input->name);
    }
    const auto output = std::ranges::find_if(machine.outputs, [&](const OutputConfig& config) {
        return is_it(config) && config.is_analog() == (change.kind == ChannelKind::Analog);
    });
    return output == machine.outputs.end() ? std::nullopt : std::optional(output->name);
}

std::string change_text(const ChannelChange& change, const MachineConfig* machine) {
    const auto name = machine != nullptr ? name_of(change, *machine) : std::nullopt;
    const std::string channel = fmt::format("{} {}", kind_text(change.kind), change.channel);
    return name.value_or(channel) + " " + value_text(change);
}

}  // namespace lockstep::analysis
