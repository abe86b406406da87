#include "tests/integration/security/packet_forger.hpp"

#include <cstdint>
#include <cstring>

#include "tests/integration/security/rtps_packet.hpp"

namespace lockstep {
namespace {

enum Submessage : unsigned char { kAckNack = 0x06, kHeartbeat = 0x07, kGap = 0x08, kData = 0x15 };

void put_sequence_number(std::string& packet, std::size_t at, std::uint64_t number) {
    const auto high = static_cast<std::uint32_t>(number >> 32);
    const auto low = static_cast<std::uint32_t>(number);
    if (at + 8 > packet.size()) { return; }
    std::memcpy(&packet[at], &high, 4);
    std::memcpy(&packet[at + 4], &low, 4);
}

/// Sets a submessage's sequence number, at its offset from the header. A heartbeat has two; of a gap the last is set.
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

PacketForger::PacketForger(const std::vector<std::string>& packets, unsigned seed)
    : packets_(rtps_packets(packets)), random_(seed) {}

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
    for (const std::size_t header : submessages_of(packet)) { advance(packet, header, number); }
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
