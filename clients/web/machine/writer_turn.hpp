// Decides when a server requests the writer's lease and gives it back. Pure: the caller sends and passes the time.
#pragma once

#include <chrono>
#include <cstdint>

#include "clients/session/lease/lease_keeper.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep::web {

class WriterTurn {
public:
    using Time = std::chrono::nanoseconds;
    enum class Send : std::uint8_t { Nothing, Ask, TakeOver, Give };

    struct Lease {
        bool is_held = false;
        const Reply* answer = nullptr;  // to the last request; null if none has come yet
    };
    struct Use {
        bool wants = false;       // a command waits for the lease
        bool takes_over = false;  // one of them takes it from another writer, too
        bool has_work = false;    // a command, a jog or a job of this server is under way
    };

    /// Call it in each loop. Returns what to send now.
    Send pass(const Lease& lease, const Use& use, Time now);
    /// Gives the lease back in the next pass.
    void give() { gives_ = true; }

    bool is_held() const { return state_ == State::Held; }
    /// True if the commands that wait for the lease are refused in this loop.
    bool is_refused(bool takes_over) const { return state_ == State::Refused && takes_over_ >= takes_over; }

private:
    enum class State : std::uint8_t { Free, Asked, Held, Refused };
    void note(const Lease& lease);
    Send ask(bool takes_over);
    bool is_over(const Use& use, Time now) const;

    State state_ = State::Free;
    bool takes_over_ = false;  // the last request takes it from another writer
    bool gives_ = false;
    Time used_{};
};

}  // namespace lockstep::web
