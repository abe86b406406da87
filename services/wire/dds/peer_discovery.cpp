#include "services/wire/dds/peer_discovery.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace lockstep {
namespace {

constexpr int kProcessesOfHost =
    16;                            // that discover each other: DDS tries this many ports of each peer, from index 0 on
constexpr int kAskEvery_ms = 800;  // a new process gets answers at once
constexpr int kGivenUpAfter_ms = 4000;         // three ARP requests, a second each, and the delay of a busy host
constexpr std::int64_t kQuestionBytes = 1280;  // as the kernel counts them

}  // namespace

std::string peer_discovery(const std::vector<std::string>& peers) {
    std::string listed;
    for (const std::string& peer : peers) { listed += "<Peer address=\"" + peer + "\"/>"; }
    return fmt::format(
        "<General><AllowMulticast>false</AllowMulticast></General><Discovery><SPDPInterval>{} ms</SPDPInterval>"
        "<LeaseDuration>{} ms</LeaseDuration><ParticipantIndex>auto</ParticipantIndex>"
        "<MaxAutoParticipantIndex>{}</MaxAutoParticipantIndex><Peers>{}</Peers></Discovery>"
        "<Internal><SocketSendBufferSize max=\"{} B\"/></Internal>",
        kAskEvery_ms, kPeerLease.count(), kProcessesOfHost, listed, peer_send_buffer(peers.size()));
}

std::int64_t peer_send_buffer(std::size_t peers) {
    constexpr std::int64_t kOfOnePeer = kQuestionBytes * kProcessesOfHost * (kGivenUpAfter_ms / kAskEvery_ms);
    return kMotionSendBuffer + kOfOnePeer * (static_cast<std::int64_t>(std::max(peers, std::size_t{1})) - 1);
}

}  // namespace lockstep
