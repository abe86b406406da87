#include "clients/grbl/lobby.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "clients/grbl/channel.hpp"
#include "clients/grbl/protocol/grbl.hpp"

namespace lockstep::grbl {
namespace {

enum class Heard : std::uint8_t { Nothing, Bytes, End };

Heard heard(const Descriptor& connection) {
    char first = 0;
    const ssize_t count = recv(connection.get(), &first, 1, MSG_PEEK | MSG_DONTWAIT);
    if (count > 0) { return Heard::Bytes; }
    return count < 0 && (errno == EAGAIN || errno == EINTR) ? Heard::Nothing : Heard::End;
}

}  // namespace

void Lobby::accept() {
    for (std::size_t i = 0; i < kMost; ++i) {
        auto connection = accept_from(listener_);
        if (!connection) { return; }
        if (!write_to(*connection, std::string("\r\n") + kGreeting + "\r\n")) { continue; }
        waiting_.push_back(*std::move(connection));
        if (waiting_.size() > kMost) { waiting_.pop_front(); }
    }
}

std::deque<Descriptor>::iterator Lobby::speaker() {
    accept();
    std::erase_if(waiting_, [](const Descriptor& one) { return heard(one) == Heard::End; });
    return std::ranges::find_if(waiting_, [](const Descriptor& one) { return heard(one) == Heard::Bytes; });
}

bool Lobby::has_speaker() { return speaker() != waiting_.end(); }

std::optional<Descriptor> Lobby::take_speaker() {
    const auto found = speaker();
    if (found == waiting_.end()) { return std::nullopt; }
    Descriptor taken = std::move(*found);
    waiting_.erase(found);
    return taken;
}

void Lobby::turn_away(const std::string& message) {
    for (std::size_t i = 0; i < kMost; ++i) {
        const auto connection = accept_from(listener_);
        if (!connection) { break; }
        (void)write_to(*connection, message);
    }
    for (const Descriptor& one : std::exchange(waiting_, {})) { (void)write_to(one, message); }
}

}  // namespace lockstep::grbl
