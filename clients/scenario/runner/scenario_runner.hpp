// Runs scenarios in parallel, each in its own sandbox.
#pragma once

#include <expected>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "clients/scenario/model/scenario.hpp"

namespace lockstep::scenario {

struct RunnerOptions {
    int at_a_time = 1;
    std::string image = "lockstep";             // for scenarios in containers
    std::optional<std::filesystem::path> keep;  // directory for kept logs, with a subdirectory for each scenario's logs
    std::function<void(const std::string&)> progress;            // called now and then: which ones are running
    std::function<void(const proto::ScenarioReport&)> finished;  // called with each report as its scenario ends
    std::function<bool()> interrupted;                           // true ends all now
};

/// Reports are in the order of `scenarios`. Scenarios that an interruption ends or prevents are reported as broken.
/// Fails if no scenario can run or the logs cannot be kept.
std::expected<proto::ScenarioRunReport, std::string> run_scenarios(const std::vector<Scenario>& scenarios,
                                                                   const RunnerOptions& options);

}  // namespace lockstep::scenario
