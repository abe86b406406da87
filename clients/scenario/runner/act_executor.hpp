// Executes the acts of a scenario on processes, on the network, or by commands to the machine, and undoes the acts
// with a duration.
#pragma once

#include <chrono>
#include <expected>
#include <filesystem>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clients/scenario/runner/network.hpp"
#include "clients/scenario/runner/process_set.hpp"
#include "clients/session/session.hpp"

namespace lockstep::scenario {

/// The files that tell the simulated devices what people do to them.
struct DeviceFiles {
    std::filesystem::path closed_inputs;
    std::filesystem::path pushes;
};

class ActExecutor {
public:
    ActExecutor(ProcessSet& processes, Network& network, Session& session, DeviceFiles files)
        : processes_(processes), network_(network), session_(session), files_(std::move(files)) {}

    /// The error says why the act failed, or quotes the machine's refusal.
    std::expected<void, std::string> execute(const Asked::Act& act);

    /// Returns and removes the next act that undoes an earlier one and is due now. Call it until it returns nullopt.
    std::optional<Asked::Act> take_due();
    bool has_more_to_undo() const { return !undoing_.empty(); }

private:
    struct Undo {
        std::chrono::nanoseconds at;
        Asked::Act act;
    };

    std::expected<void, std::string> apply(const Asked::Act& act);
    std::expected<void, std::string> lose(const Asked::Loss& loss);
    std::expected<void, std::string> command(Asked::Command word);
    std::expected<void, std::string> reset();
    std::expected<void, std::string> stop_at_once();
    std::expected<void, std::string> ask(const Command& command);
    std::expected<void, std::string> set_input(const std::string& name, bool closed);
    std::expected<void, std::string> push(const Asked::Push& push);

    ProcessSet& processes_;
    Network& network_;
    Session& session_;
    DeviceFiles files_;
    std::set<std::string> closed_;             // inputs
    std::map<std::string, double> pushed_mm_;  // of motors, so far
    std::vector<Undo> undoing_;
};

}  // namespace lockstep::scenario
