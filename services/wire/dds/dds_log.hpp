// The messages of DDS itself: peers that it refuses, files that it cannot use. DDS reports them on its own threads, and
// repeats those about one unauthenticated peer ten times a second.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {

/// Passes the first of each kind of message, and one of that kind in each period after; messages that differ only in
/// identities are of one kind. Pure.
class RepeatFilter {
public:
    /// The message to report, with how many of its kind were held back; nothing: it is held back.
    std::optional<std::string> pass(std::chrono::nanoseconds now, const std::string& message);

private:
    static constexpr std::chrono::seconds kPeriod{10};
    static constexpr std::size_t kMaxKinds = 64;  // beyond it all kinds are new again

    struct Kind {
        std::chrono::nanoseconds reported;
        std::size_t held_back = 0;
    };
    std::map<std::string, Kind> kinds_;
};

/// Sends DDS's warnings and errors to `to`, filtered, on threads of DDS, one at a time. One receiver per process.
void forward_dds_log(std::function<void(const std::string&)> to);

/// Reports a text there, as if DDS had reported it.
void add_dds_message(const std::string& text);

/// The last message; empty: none yet.
std::string last_dds_message();

/// Also report unauthenticated peers; the domain's profile must trace discovery. It replaces any other trace of
/// DDS.
void watch_unauthenticated_peers();

/// The unauthenticated peers to report now (unauthenticated_peers.hpp).
std::vector<std::string> unauthenticated_peers(std::chrono::nanoseconds now);

/// This process has joined. Before that DDS refuses all peers, which is no error of theirs.
void note_joined();

}  // namespace lockstep
