// The dead-man's switch of jogs: which client jogs, and until when. Pure: the caller passes the time.
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <expected>
#include <map>
#include <optional>
#include <string>

#include "clients/web/request/orders.hpp"

namespace lockstep::web {

class JogGuard {
public:
    using Time = std::chrono::nanoseconds;

    /// The meaning of an accepted order. New: the press of a key, which begins a jog even if an earlier jog has ended
    /// by itself.
    enum class Press : std::uint8_t { New, Renewed, Released };
    /// Fails if another client jogs, the order's press is over, or a step is in progress and the order is another
    /// press.
    std::expected<Press, Problem> take(const JogOrder& order, Time now);
    /// Returns true once, when the jog's time is over. A step has no such time until it is complete.
    bool runs_out(Time now);
    /// The step in progress has ended. Its client may ask for a while whether it has.
    void complete(Time now);
    bool is_step() const { return is_step_; }
    /// Returns true if the jog ended with this stream. A step goes on.
    bool end_stream(const std::string& stream);
    /// The machine refused the jog, or ended it.
    void end();
    bool is_pressed() const { return until_.has_value(); }

private:
    static constexpr std::size_t kMostClients = 256;  // clients with a remembered press
    bool is_over(const JogOrder& order) const;
    void note_over();

    std::string client_;  // its stream; empty if it names none
    std::optional<std::uint64_t> press_;
    std::optional<Time> until_;                  // nullopt if nobody jogs
    bool is_step_ = false;                       // a step is in progress
    std::map<std::string, std::uint64_t> over_;  // the last press of each client that is over
    std::deque<std::string> order_;              // the clients in over_, the oldest first
};

}  // namespace lockstep::web
