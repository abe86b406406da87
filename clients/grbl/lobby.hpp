// The TCP connections that have not sent anything yet. A connection becomes the sender with its first byte, so one that
// sends nothing keeps no other out.
#pragma once

#include <cstddef>
#include <deque>
#include <optional>
#include <string>

#include "clients/channel/bytes.hpp"

namespace lockstep::grbl {

class Lobby {
public:
    static constexpr std::size_t kMost = 32;  // if more connect, the oldest is closed

    explicit Lobby(Descriptor listener) : listener_(std::move(listener)) {}

    /// Accepts and greets new connections. Returns whether a connection has sent its first bytes.
    bool has_speaker();
    /// The same, and returns that connection; nullopt if there is none.
    std::optional<Descriptor> take_speaker();
    /// Sends this message to all, also to those that wait to be accepted, and closes them.
    void turn_away(const std::string& message);

private:
    void accept();
    std::deque<Descriptor>::iterator speaker();

    Descriptor listener_;
    std::deque<Descriptor> waiting_;  // the oldest first
};

}  // namespace lockstep::grbl
