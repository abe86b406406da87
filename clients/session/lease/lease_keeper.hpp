// A client's side of the writer's lease: requests it, repeats the request to keep it, and gives it back. Pure: the
// caller sends the commands and passes the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "core/protocol/messages.hpp"

namespace lockstep {

/// A client that stays open gives the lease back after this time without work, so that other writers get the machine.
inline constexpr std::chrono::seconds kGiveLeaseAfter{2};

class LeaseKeeper {
public:
    LeaseKeeper(Identity client, LeaseHolder writer) : client_(client) { write_as(std::move(writer)); }

    /// Sets the writer of later requests. Give the lease back first. An id of 0 stands for this client's identity,
    /// which no other client shares.
    void write_as(LeaseHolder writer);
    const LeaseHolder& writer() const { return writer_; }

    /// Requests the lease until an answer comes. `takes_over` takes it from another writer, too.
    void ask(std::uint64_t sequence, bool takes_over);
    /// Stops keeping the lease. Returns the command to send, or nullopt if the lease was not requested.
    std::optional<Command> give(std::uint64_t sequence);
    /// Returns the command to send now, or nullopt if none is due.
    std::optional<Command> due(std::chrono::nanoseconds now);
    /// Returns false if the reply answers something else.
    bool take_answer(const Reply& reply);

    /// The answer to the last ask() or give(); nullopt if none has come yet.
    const std::optional<Reply>& answer() const { return answer_; }
    /// True if the lease was granted and not refused since.
    bool is_held() const { return is_asked_ && answer_ && answer_->status == ReplyStatus::Accepted; }

    static constexpr std::chrono::milliseconds kAskAgainAfter{250};

private:
    Command command(std::uint64_t sequence, CommandKind kind) const;

    Identity client_;
    LeaseHolder writer_;
    bool is_asked_ = false;
    bool takes_over_ = false;
    std::uint64_t sequence_ = 0;  // of the last ask() or give()
    std::optional<Reply> answer_;
    std::optional<std::chrono::nanoseconds> sent_;
};

}  // namespace lockstep
