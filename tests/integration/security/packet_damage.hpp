// Damages RTPS packets like a faulty network, or an attacker on it.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace lockstep {

class PacketDamage {
public:
    /// packets: Ethernet frames with IPv4 and UDP, from PacketTap; those that are not of DDS are left out.
    PacketDamage(const std::vector<std::string>& packets, unsigned seed);

    /// One of the packets, with up to eight bits flipped, cut short, with another submessage length, or with two of its
    /// submessages exchanged.
    std::string next();

private:
    void flip_bits(std::string& packet);
    void cut_short(std::string& packet);
    void change_length(std::string& packet);
    void swap_submessages(std::string& packet);
    std::size_t below(std::size_t limit) { return random_() % limit; }

    std::vector<std::string> packets_;
    std::mt19937_64 random_;
};

}  // namespace lockstep
