// Bounds how many connections a server has and for how long, so that no client can keep others out. A new connection is
// always accepted: if there are too many, an older one is closed. Connections that have not sent a valid token go
// first, those of the address with most of them before all others. Pure: the caller passes the time and closes.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <utility>

namespace lockstep::web {

class ConnectionLimits {
public:
    using Time = std::chrono::nanoseconds;
    using Id = const void*;
    /// Closes a connection soon; forget() follows. Called with the lock held.
    using Close = std::function<void(Id)>;

    /// What a connection waits for: the head of the next request, the body of a request, the client to read the answer,
    /// or this server to send it (or the next event of a stream). If there are too many connections, those that wait
    /// for an earlier value of this list are closed first.
    enum class Waits : std::uint8_t { ForHead, ForBody, ForReader, ForServer };

    static constexpr std::size_t kMostUnknown = 128;  // connections without a valid token
    static constexpr std::size_t kMostUnknownOfAddress = 64;
    static constexpr std::size_t kMostSignedIn = 256;     // connections with a valid token
    static constexpr std::chrono::seconds kPatience{10};  // for a head; for a body or a reader, this and its bytes
    static constexpr std::chrono::seconds kIdle{20};      // for the next head, of a connection that is signed in
    static constexpr std::size_t kLeastRate_bytes_s = 64 * 1024;

    explicit ConnectionLimits(Close close) : close_(std::move(close)) {}

    void begin(Id connection, const std::string& peer, Time now);
    /// `bytes`: the most that the client has to send, or to read, until the next call.
    void wait(Id connection, Waits what, std::size_t bytes, Time now);
    void sign_in(Id connection);
    void forget(Id connection);
    /// Closes the connections whose time is over.
    void close_late(Time now);

private:
    struct Entry {
        std::uint64_t number = 0;  // rises from connection to connection
        std::string peer;
        Time until{};
        Waits waits = Waits::ForHead;
        bool is_signed_in = false;
        bool is_closing = false;
    };
    using Entries = std::map<Id, Entry>;
    void close(Entries::iterator entry);
    void keep_bound_of_unknown();
    void keep_bound_of_signed_in(Id newest);

    Close close_;
    std::mutex mutex_;  // protects the members below
    Entries entries_;
    std::uint64_t last_number_ = 0;
};

}  // namespace lockstep::web
