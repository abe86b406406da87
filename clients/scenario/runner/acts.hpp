// Does what a scenario's acts say: to processes, to the network, or by a command to the machine; and undoes what was to
// last for a time.
#pragma once

#include <chrono>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "clients/scenario/runner/cast.hpp"
#include "clients/scenario/runner/network.hpp"
#include "clients/session/session.hpp"

namespace lockstep::scenario {

class Acts {
public:
    Acts(Cast& cast, Network& network, Session& session) : cast_(cast), network_(network), session_(session) {}

    /// Error: why it could not be done, or the machine's refusal.
    std::expected<void, std::string> act(const Asked::Act& act);

    /// What is due to be undone now, if anything is; it is taken from the list. Call it until it gives none.
    std::optional<Asked::Act> take_due();
    bool has_more_to_undo() const { return !undoing_.empty(); }

private:
    struct Undo {
        std::chrono::nanoseconds at;
        Asked::Act act;
    };

    std::expected<void, std::string> do_it(const Asked::Act& act);
    std::expected<void, std::string> lose(const Asked::Loss& loss);
    std::expected<void, std::string> command(Asked::Command word);
    std::expected<void, std::string> reset();
    std::expected<void, std::string> stop_at_once();
    std::expected<void, std::string> ask(const Command& command);

    Cast& cast_;
    Network& network_;
    Session& session_;
    std::vector<Undo> undoing_;
};

}  // namespace lockstep::scenario
