// What a record says that is judged by nobody else: when axes were at rest, and with which frame each ended an epoch.
#pragma once

#include <expected>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/protocol/messages.hpp"

namespace lockstep::scenario {

/// From the first to the last word of an axis that it is at rest.
struct RestSpan {
    Tick from;
    Tick to;
};

struct EpochEnd {
    FrameNumber frame = 0;
    bool tail = false;
    bool operator==(const EpochEnd&) const = default;
};

struct RecordFacts {
    std::map<std::string, std::vector<RestSpan>> rests;       // of each axis, in the order of time
    std::map<Epoch, std::map<std::string, EpochEnd>> epochs;  // of each axis that ran it

    /// When these axes were first at rest all together, from then on. Nothing: the record knows of no such time.
    std::optional<Tick> all_at_rest(const std::vector<std::string>& axes, Tick since) const;

    /// How many epochs two of these axes, or more, have run.
    std::ptrdiff_t epochs_of(const std::vector<std::string>& axes) const;

    /// The first epoch that axes of these ended differently, in words; nothing: there is none.
    std::optional<std::string> parting(const std::vector<std::string>& axes) const;
};

/// Error: the log cannot be read.
std::expected<RecordFacts, std::string> record_facts(const std::filesystem::path& log);

}  // namespace lockstep::scenario
