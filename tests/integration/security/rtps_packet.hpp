// The layout of an RTPS packet (OMG DDSI-RTPS 2.2, 8.3 and 9.4), for packets of this host: little endian.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace lockstep {

// After the headers of Ethernet, IPv4 and UDP.
inline constexpr std::size_t kRtps = 14 + 20 + 8;
inline constexpr std::size_t kGuidPrefix = kRtps + 8;
inline constexpr std::size_t kSubmessages = kRtps + 20;
inline constexpr std::size_t kSubmessageHeader = 4;
inline constexpr std::size_t kSubmessageLength = 2;  // in the header: 16 bits

/// Those of the packets that are RTPS packets.
std::vector<std::string> rtps_packets(const std::vector<std::string>& packets);

/// Where the submessages of a packet begin, in order.
std::vector<std::size_t> submessages_of(const std::string& packet);

}  // namespace lockstep
