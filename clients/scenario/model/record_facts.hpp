// Facts of the record that only scenarios evaluate: when axes were at rest, with which frame each axis ended an epoch,
// and what changed at the pins of devices.
#pragma once

#include <expected>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/hardware/output_change.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::scenario {

/// The time from the first to the last message of an axis at rest.
struct RestSpan {
    Tick from;
    Tick to;
};

struct EpochEnd {
    FrameNumber frame = 0;
    bool tail = false;
    bool operator==(const EpochEnd&) const = default;
};

/// A change of an input or output, with its time by the device's clock in machine time.
struct NotedChange {
    Tick at;
    ChannelEvent event;
};

struct RecordFacts {
    std::map<std::string, std::vector<RestSpan>> rests;        // of each axis, in the order of time
    std::map<Epoch, std::map<std::string, EpochEnd>> epochs;   // the end of each axis that ran the epoch
    std::map<std::string, std::vector<NotedChange>> channels;  // of each motor's device, in the order of time
    std::map<std::string, Tick> last_position;                 // of each motor: when it last reported one

    /// Returns the first time at or after `since` at which all of these axes were at rest, or nullopt if none is on
    /// record.
    std::optional<Tick> all_at_rest(const std::vector<std::string>& axes, Tick since) const;

    /// Returns the number of epochs that at least two of these axes ran.
    std::ptrdiff_t epochs_of(const std::vector<std::string>& axes) const;

    /// Returns a description of the first epoch that these axes ended differently, or nullopt if there is none.
    std::optional<std::string> parting(const std::vector<std::string>& axes) const;
};

/// Fails if the log cannot be read.
std::expected<RecordFacts, std::string> record_facts(const std::filesystem::path& log);

}  // namespace lockstep::scenario
