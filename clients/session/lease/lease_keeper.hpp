// A client's side of the writer's lease: asks for it, repeats the request to keep it, and gives it back. Pure: the
// caller sends, and gives the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "core/protocol/messages.hpp"

namespace lockstep {

class LeaseKeeper {
public:
    LeaseKeeper(Identity client, LeaseHolder writer) : client_(client) { write_as(std::move(writer)); }

    /// For what is asked from now on: give the lease first. With an identity of 0 no other client shares the lease.
    void write_as(LeaseHolder writer);
    const LeaseHolder& writer() const { return writer_; }

    /// Asks until it is answered. `takes_over`: from another writer, too.
    void ask(std::uint64_t sequence, bool takes_over);
    /// Keeps it no longer. Returns the command to send; nothing: it was not asked for.
    std::optional<Command> give(std::uint64_t sequence);
    /// The command to send now.
    std::optional<Command> due(std::chrono::nanoseconds now);
    /// False: it answers something else.
    bool take_answer(const Reply& reply);

    /// To what was asked or given last. Nothing: none has come yet.
    const std::optional<Reply>& answer() const { return answer_; }
    /// It was granted, and not refused since.
    bool is_held() const { return is_asked_ && answer_ && answer_->status == ReplyStatus::Accepted; }

    static constexpr std::chrono::milliseconds kAskAgainAfter{250};

private:
    Command command(std::uint64_t sequence, CommandKind kind) const;

    Identity client_;
    LeaseHolder writer_;
    bool is_asked_ = false;
    bool takes_over_ = false;
    std::uint64_t sequence_ = 0;  // of what was asked or given last
    std::optional<Reply> answer_;
    std::optional<std::chrono::nanoseconds> sent_;
};

}  // namespace lockstep
