// How processes discover each other without multicast: each contacts every peer, on the ports that DDS assigns to the
// processes of a host in turn, repeatedly, whether or not a process is there.
//
// A packet to an address without a host waits in the kernel until ARP fails, after 3 to 4 s, and counts as queued in
// the socket that carries motion too. If that socket's buffer is full, senders wait for that long: an axis falls
// silent. So peers are contacted rarely, and the buffer has room for the packets to all absent peers.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace lockstep {

/// The peer settings of DDS, as XML: of the domain's General, Discovery and Internal.
std::string peer_discovery(const std::vector<std::string>& peers);

/// How long a process that ended without notice is regarded as present: five chances to be received.
constexpr std::chrono::milliseconds kPeerLease{4000};

/// The send buffer, in bytes as the kernel counts them, in which motion has room though all peers are absent. The
/// kernel gives twice net.core.wmem_max at most.
std::int64_t peer_send_buffer(std::size_t peers);

/// The part of it that is left for motion.
constexpr std::int64_t kMotionSendBuffer = 64 * 1024;

}  // namespace lockstep
