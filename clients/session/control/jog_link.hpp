// Keeps a jog alive: renews its command every 5 ms. When this process ends, the axes brake.
#pragma once

#include <chrono>
#include <optional>
#include <vector>

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

    bool is_pressed() const { return tracker_ && !tracker_->command().jogs.empty(); }
    /// The coordinator's newest reply to the newest press or release; null if none has come yet.
    const Reply* reply() const;
    /// True if the jog was accepted and has ended.
    bool is_over() const;
    /// True if the coordinator has not answered the newest press or release; it is sent no more.
    bool is_unanswered() const { return step_ == CommandStep::GaveUp; }

private:
    static constexpr std::chrono::nanoseconds kLeastWait = std::chrono::milliseconds{1};

    Session& session_;
    std::optional<CommandTracker> tracker_;  // of the newest press or release
    CommandStep step_ = CommandStep::Wait;
};

}  // namespace lockstep
