// How processes discover each other without multicast. Each repeatedly contacts every peer host, on all ports that DDS
// assigns to the processes of a host, even if no process uses them.
//
// A packet to an address without a host waits in the kernel until ARP fails, after 3 to 4 s. Until then it occupies the
// send buffer of the socket that also carries motion. If that buffer is full, senders wait for that time and an axis
// falls silent. So DDS contacts peers rarely, and the buffer has room for the packets to all absent peers.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace lockstep {

/// Returns the peer settings of DDS, as XML: the domain's elements General, Discovery and Internal.
std::string peer_discovery(const std::vector<std::string>& peers);

/// How long a process that ended without notice is regarded as present: five announcements.
constexpr std::chrono::milliseconds kPeerLease{4000};

/// Returns the send buffer, in bytes as the kernel counts them, that has room for motion even if all peers are absent.
/// The kernel grants at most twice net.core.wmem_max.
std::int64_t peer_send_buffer(std::size_t peers);

/// The part of the send buffer that is left for motion.
constexpr std::int64_t kMotionSendBuffer = 64 * 1024;

}  // namespace lockstep
