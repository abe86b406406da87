// Executes the acts of a scenario on processes, on the network, or by commands to the machine, and undoes the acts
// with a duration.
#pragma once

#include <chrono>
#include <expected>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "clients/scenario/runner/network.hpp"
#include "clients/scenario/runner/process_set.hpp"
#include "clients/session/session.hpp"

namespace lockstep::scenario {

class ActExecutor {
public:
    /// `closed_inputs`: the file that tells the devices which inputs are closed.
    ActExecutor(ProcessSet& processes, Network& network, Session& session, std::filesystem::path closed_inputs)
        : processes_(processes), network_(network), session_(session), inputs_file_(std::move(closed_inputs)) {}

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

    ProcessSet& processes_;
    Network& network_;
    Session& session_;
    std::filesystem::path inputs_file_;
    std::set<std::string> closed_;  // inputs
    std::vector<Undo> undoing_;
};

}  // namespace lockstep::scenario
