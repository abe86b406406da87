// Detects peers that join the network without authenticating, from DDS's discovery trace. Pure.
//
// DDS itself reports a failed authentication only if it requested the authentication. It does not report a peer without
// a certificate.
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
    /// Reads a line of DDS's discovery trace. Returns the text to report at once if a peer without a certificate
    /// joined.
    std::optional<std::string> note_line(std::chrono::nanoseconds now, std::string_view line);

    /// Reports once each peer with a certificate that joined, is still present, and has not authenticated within
    /// kPatience.
    std::vector<std::string> due(std::chrono::nanoseconds now);

private:
    static constexpr std::chrono::seconds kPatience{2};  // many times the duration of the handshake
    static constexpr std::size_t kMaxPending = 256;      // beyond it peers are not reported, but still excluded

    struct Peer {
        std::chrono::nanoseconds joined;
        std::string address;
    };
    std::map<std::string, Peer, std::less<>> pending_;
};

}  // namespace lockstep
