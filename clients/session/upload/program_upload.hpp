// The program that a client sends, one at a time: its sender, what feeds it, and for how long the client waits for the
// coordinator. The caller passes the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "clients/session/follow/owner_watch.hpp"
#include "clients/session/upload/program_sender.hpp"

namespace lockstep {

class ProgramUpload {
public:
    using Feed = std::function<void(ProgramSender& sender)>;

    explicit ProgramUpload(Identity client) : client_(client) {}

    /// Begins a program with a new id. The caller appends to the sender, which is valid until another program is begun,
    /// or close(). `feed`: each call of due() calls it if there is room for more blocks.
    ProgramSender& open(const ProgramHead& head, const std::optional<gcode::ProgramValues>& values = {},
                        Feed feed = {});
    /// Calls the feed no more; sends what it has appended.
    void end_feed() { feed_ = {}; }
    /// Sends no more of the program.
    void close();

    /// The sender of the last program; null if none was begun.
    const ProgramSender* sender() const { return sender_ ? &*sender_ : nullptr; }
    /// Feeds the sender and returns the chunks to send now.
    std::vector<ProgramChunk> due(std::chrono::nanoseconds now);
    /// Returns false if the reply answers something else. `now`: OwnerWatch::running_time().
    bool take_answer(const Reply& reply, std::chrono::nanoseconds now);
    /// True if the owner is silent for CommandTracker::kPatience, or publishes states and has not answered for
    /// kPlanPatience. Call it in each loop of a wait for the coordinator. `now`: as in take_answer().
    bool is_overdue(const OwnerSight& owner, std::chrono::nanoseconds now);

private:
    Identity client_;
    std::uint32_t programs_ = 0;  // begun so far
    std::optional<ProgramSender> sender_;
    Feed feed_;
    std::optional<std::chrono::nanoseconds> answered_;  // or when the wait for the first answer began
    std::optional<std::chrono::nanoseconds> received_;  // when the owner was last not silent, or the wait began
};

}  // namespace lockstep
