#include "tests/integration/security/rtps_packet.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <iterator>

namespace lockstep {

std::vector<std::string> rtps_packets(const std::vector<std::string>& packets) {
    std::vector<std::string> found;
    std::ranges::copy_if(packets, std::back_inserter(found), [](const std::string& packet) {
        return packet.size() > kSubmessages && packet.compare(kRtps, 4, "RTPS") == 0;
    });
    return found;
}

std::vector<std::size_t> submessages_of(const std::string& packet) {
    std::vector<std::size_t> begins;
    for (std::size_t at = kSubmessages; at + kSubmessageHeader <= packet.size();) {
        begins.push_back(at);
        std::uint16_t length = 0;
        std::memcpy(&length, &packet[at + kSubmessageLength], sizeof length);
        if (length == 0) { break; }  // the last, up to the packet's end
        at += kSubmessageHeader + length;
    }
    return begins;
}

}  // namespace lockstep
