// How processes find each other without multicast: each asks every peer, on the ports that DDS gives to one process of
// a host after the other, again and again, whether or not somebody is there.
//
// What goes to an address where nobody is waits in the kernel until ARP gives it up, after 3 to 4 s, and counts as sent
// by the socket that carries motion too. A socket whose buffer is full makes whoever sends wait for that long: an axis
// falls silent. So peers are asked at leisure, and the buffer holds what all of them but this one may leave there.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace lockstep {

/// What DDS is told of its peers, as XML: of the domain's General, Discovery and Internal.
std::string peer_discovery(const std::vector<std::string>& peers);

/// How long a process that has ended without a word is taken for present: five chances to be heard.
constexpr std::chrono::milliseconds kPeerLease{4000};

/// The send buffer, in bytes as the kernel counts them, in which motion has room though no peer is there. The kernel
/// gives twice net.core.wmem_max at most.
std::int64_t peer_send_buffer(std::size_t peers);

/// Of that: what is left for motion.
constexpr std::int64_t kMotionSendBuffer = 64 * 1024;

}  // namespace lockstep
