// The wire format: OMG DDSI-RTPS 2.2, 8.3 and 9.4. All packets here are little endian, since this host is.
#include "tests/integration/security/packet_forger.hpp"

#include <cstdint>
#include <cstring>

namespace lockstep {
namespace {

constexpr std::size_t kRtps = 14 + 20 + 8;
constexpr std::size_t kGuidPrefix = kRtps + 8;
constexpr std::size_t kSubmessages = kRtps + 20;

enum Submessage : unsigned char { kAckNack = 0x06, kHeartbeat = 0x07, kGap = 0x08, kData = 0x15 };

bool is_rtps(const std::string& packet) {
    return packet.size() > kSubmessages && packet.compare(kRtps, 4, "RTPS") == 0;
}

void put_sequence_number(std::string& packet, std::size_t at, std::uint64_t number) {
    const auto high = static_cast<std::uint32_t>(number >> 32);
    const auto low = static_cast<std::uint32_t>(number);
    if (at + 8 > packet.size()) { return; }
    std::memcpy(&packet[at], &high, 4);
    std::memcpy(&packet[at + 4], &low, 4);
}

/// A submessage's sequence number is so far behind its header; of a heartbeat and a gap there are two.
void advance(std::string& packet, std::size_t header, std::uint64_t number) {
    switch (static_cast<unsigned char>(packet[header])) {
        case kAckNack: return put_sequence_number(packet, header + 12, number);
        case kData: return put_sequence_number(packet, header + 16, number);
        case kHeartbeat:
            put_sequence_number(packet, header + 12, number);
            return put_sequence_number(packet, header + 20, number);
        case kGap: return put_sequence_number(packet, header + 20, number);
        default: return;
    }
}

}  // namespace

PacketForger::PacketForger(const std::vector<std::string>& packets, unsigned seed) : random_(seed) {
    for (const std::string& packet : packets) {
        if (is_rtps(packet)) { packets_.push_back(packet); }
    }
}

std::string PacketForger::next() {
    std::string packet = packets_[below(packets_.size())];
    switch (below(4)) {
        case 1: advance_sequence_numbers(packet); break;
        case 2: change_sender(packet); break;
        case 3: change_lease(packet); break;
        default: break;
    }
    return packet;
}

void PacketForger::advance_sequence_numbers(std::string& packet) {
    const std::uint64_t number = (std::uint64_t{1} << (20 + below(42))) + below(1000);
    for (std::size_t header = kSubmessages; header + 4 <= packet.size();) {
        std::uint16_t length = 0;
        std::memcpy(&length, &packet[header + 2], 2);
        advance(packet, header, number);
        if (length == 0) { return; }  // the last
        header += 4U + length;
    }
}

void PacketForger::change_sender(std::string& packet) {
    char& byte = packet[kGuidPrefix + below(12)];
    byte = static_cast<char>(byte ^ (1 << below(8)));
}

/// PID_PARTICIPANT_LEASE_DURATION, 8 bytes.
void PacketForger::change_lease(std::string& packet) {
    const std::size_t at = packet.find(std::string("\x02\x00\x08\x00", 4), kSubmessages);
    if (at == packet.npos || at + 12 > packet.size()) { return; }
    const bool is_long = below(2) == 0;
    packet.replace(at + 4, 8, is_long ? std::string("\xff\xff\xff\x7f\xff\xff\xff\xff", 8) : std::string(8, '\0'));
}

}  // namespace lockstep
