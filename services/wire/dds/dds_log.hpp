// Forwards the messages of DDS itself, such as peers that it refuses and files that it cannot use. DDS reports them on
// its own threads, and repeats those about an unauthenticated peer ten times a second.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace lockstep {

/// Passes the first message of each kind, then one of that kind in each kPeriod. Messages that differ only in
/// identities are of one kind. Pure.
class RepeatFilter {
public:
    /// Returns the message to report, with the number held back of its kind; nullopt if it holds this one back.
    std::optional<std::string> pass(std::chrono::nanoseconds now, const std::string& message);

private:
    static constexpr std::chrono::seconds kPeriod{10};
    static constexpr std::size_t kMaxKinds = 64;  // at this number all kinds are forgotten

    struct Kind {
        std::chrono::nanoseconds reported;
        std::size_t held_back = 0;
    };
    std::map<std::string, Kind> kinds_;
};

/// Passes DDS's warnings and errors to `to`, filtered, on threads of DDS, one at a time. A process has one receiver.
void forward_dds_log(std::function<void(const std::string&)> to);

/// Reports a text to that receiver, as if DDS had reported it.
void add_dds_message(const std::string& text);

/// The last message; empty if none has come yet.
std::string last_dds_message();

/// Makes unauthenticated_peers() work. The domain's profile must trace discovery. This replaces any other trace of DDS.
void watch_unauthenticated_peers();

/// Returns texts about the unauthenticated peers to report now (unauthenticated_peers.hpp).
std::vector<std::string> unauthenticated_peers(std::chrono::nanoseconds now);

/// Notes that this process has joined. Until then DDS refuses all peers, so such messages are not reported.
void note_joined();

}  // namespace lockstep
