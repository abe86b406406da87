// Plays scenarios, some at a time, each in a world of its own.
#pragma once

#include <expected>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

struct SeasonOptions {
    int at_a_time = 1;
    std::string image = "lockstep";             // of those that are played in containers
    std::optional<std::filesystem::path> keep;  // a directory; each scenario's logs go into one of its name in it
    std::function<void(const std::string&)> progress;          // now and then: what is played
    std::function<void(const proto::ScenarioReport&)> played;  // each, as it ends
    std::function<bool()> interrupted;                         // true: end all now
};

/// In the order of `scenarios`; those that were not begun when it was interrupted are broken. Error: none can be
/// played, or the logs cannot be kept.
std::expected<proto::ScenarioRunReport, std::string> play_all(const std::vector<Scenario>& scenarios,
                                                              const SeasonOptions& options);

}  // namespace lockstep::scenario
