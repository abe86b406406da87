// Keeps a jog alive: repeats its command every 5 ms. When this process ends, the axes brake.
#pragma once

#include <chrono>
#include <vector>

#include "clients/session/control/jog_repeat.hpp"
#include "clients/session/session.hpp"

namespace lockstep {

class JogLink {
public:
    explicit JogLink(Session& session) : session_(session) {}

    /// Sets the axes to jog from now on. Sends nothing if they are the current ones.
    void press(const std::vector<JogAxis>& jogs);
    void release() { press({}); }
    /// Receives messages until `until`, and renews the jog meanwhile.
    void pass(std::chrono::nanoseconds until);

    bool is_pressed() const { return !command_.jogs.empty(); }
    /// The coordinator's reply to the newest press or release; null if none has come yet.
    const Reply* reply() const { return is_begun_ ? session_.reply_to(command_) : nullptr; }
    /// True if the jog was accepted and has ended.
    bool is_over() const;

private:
    void send(std::chrono::nanoseconds now);
    bool is_repeated() const;

    Session& session_;
    Command command_{.kind = CommandKind::Jog};
    bool is_begun_ = false;  // the newest press or release was sent
    JogRepeat repeat_;
};

}  // namespace lockstep
