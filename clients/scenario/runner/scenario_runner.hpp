// Runs scenarios in parallel, each in a sandbox of its own.
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
    std::optional<std::filesystem::path> keep;  // a directory; each scenario's logs go into a subdirectory of its name
    std::function<void(const std::string&)> progress;            // now and then: which are running
    std::function<void(const proto::ScenarioReport&)> finished;  // each, as it ends
    std::function<bool()> interrupted;                           // true: end all now
};

/// In the order of `scenarios`; those not started before an interruption are reported as broken. Error: no scenario can
/// run, or the logs cannot be kept.
std::expected<proto::ScenarioRunReport, std::string> run_scenarios(const std::vector<Scenario>& scenarios,
                                                                   const RunnerOptions& options);

}  // namespace lockstep::scenario
