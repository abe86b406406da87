// Detects peers that join the network without authenticating, from DDS's discovery trace. Pure.
//
// DDS itself reports this only if it requested the authentication; it does not report a peer without a certificate.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace lockstep {

class UnauthenticatedPeers {
public:
    /// A line of DDS's discovery trace. Returns the text to report at once: a peer without a certificate joined.
    std::optional<std::string> note_line(std::chrono::nanoseconds now, std::string_view line);

    /// Each once: a peer with a certificate that has joined, stayed, and not authenticated within kPatience.
    std::vector<std::string> due(std::chrono::nanoseconds now);

private:
    static constexpr std::chrono::seconds kPatience{2};  // many times the duration of the handshake
    static constexpr std::size_t kMaxPending = 256;  // beyond it peers are not reported; DDS excludes them all the same

    struct Peer {
        std::chrono::nanoseconds joined;
        std::string address;
    };
    std::map<std::string, Peer, std::less<>> pending_;
};

}  // namespace lockstep
