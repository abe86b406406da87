// The dead man of jogs: who jogs, and until when. Pure: the caller gives the time.
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

    /// Of an order that is followed. New: the press of a key, which begins a jog also where one before has ended by
    /// itself.
    enum class Press : std::uint8_t { New, Renewed, Released };
    /// Error: another client jogs, or the order's press is over.
    std::expected<Press, Problem> take(const JogOrder& order, Time now);
    /// True once, when the jog's time is over.
    bool runs_out(Time now);
    /// True: the jog ended with this stream.
    bool end_stream(const std::string& stream);
    /// The machine refused the jog, or ended it.
    void end();
    bool is_pressed() const { return until_.has_value(); }

private:
    static constexpr std::size_t kMostClients = 256;  // whose last press is kept
    bool is_over(const JogOrder& order) const;
    void note_over();

    std::string client_;  // its stream; empty: one that names none
    std::optional<std::uint64_t> press_;
    std::optional<Time> until_;                  // nothing: nobody jogs
    std::map<std::string, std::uint64_t> over_;  // of each client the last press that is over
    std::deque<std::string> order_;              // of them, the oldest first
};

}  // namespace lockstep::web
