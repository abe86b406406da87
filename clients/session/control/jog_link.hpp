// A jog as its client keeps it alive: the command is repeated every 5 ms. When this process ends, the axes brake.
#pragma once

#include <chrono>
#include <vector>

#include "clients/session/control/jog_repeat.hpp"
#include "clients/session/session.hpp"

namespace lockstep {

class JogLink {
public:
    explicit JogLink(Session& session) : session_(session) {}

    /// All axes to jog from now on. Nothing is sent where they are jogged already.
    void press(const std::vector<JogAxis>& jogs);
    void release() { press({}); }
    /// Receives messages until then, and renews the jog meanwhile.
    void pass(std::chrono::nanoseconds until);

    bool is_pressed() const { return !command_.jogs.empty(); }
    /// The coordinator has answered the newest press. Null: not yet.
    const Reply* reply() const { return session_.reply_to(command_); }
    /// Accepted, and ended by itself or by others.
    bool is_over() const;

private:
    bool is_repeated() const;

    Session& session_;
    Command command_{.kind = CommandKind::Jog};
    JogRepeat repeat_;
};

}  // namespace lockstep
