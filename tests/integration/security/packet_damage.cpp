#include "tests/integration/security/packet_damage.hpp"

#include <cstdint>
#include <cstring>

#include "tests/integration/security/rtps_packet.hpp"

namespace lockstep {

PacketDamage::PacketDamage(const std::vector<std::string>& packets, unsigned seed)
    : packets_(rtps_packets(packets)), random_(seed) {}

std::string PacketDamage::next() {
    std::string packet = packets_[below(packets_.size())];
    switch (below(4)) {
        case 0: flip_bits(packet); break;
        case 1: cut_short(packet); break;
        case 2: change_length(packet); break;
        default: swap_submessages(packet); break;
    }
    return packet;
}

void PacketDamage::flip_bits(std::string& packet) {
    for (std::size_t bits = 1 + below(8); bits > 0; --bits) {
        char& byte = packet[kRtps + below(packet.size() - kRtps)];
        byte = static_cast<char>(byte ^ (1 << below(8)));
    }
}

void PacketDamage::cut_short(std::string& packet) { packet.resize(kRtps + below(packet.size() - kRtps)); }

void PacketDamage::change_length(std::string& packet) {
    const auto begins = submessages_of(packet);
    const auto length = static_cast<std::uint16_t>(random_());
    std::memcpy(&packet[begins[below(begins.size())] + kSubmessageLength], &length, sizeof length);
}

void PacketDamage::swap_submessages(std::string& packet) {
    auto begins = submessages_of(packet);
    begins.push_back(packet.size());
    std::vector<std::string> parts;
    for (std::size_t i = 0; i + 1 < begins.size(); ++i) {
        parts.push_back(packet.substr(begins[i], begins[i + 1] - begins[i]));
    }
    std::swap(parts[below(parts.size())], parts[below(parts.size())]);
    packet.resize(kSubmessages);
    for (const std::string& part : parts) { packet += part; }
}

}  // namespace lockstep
