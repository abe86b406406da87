// Alters RTPS packets of a machine as an attacker on its network could, so that they still name its members.
#pragma once

#include <cstddef>
#include <random>
#include <string>
#include <vector>

namespace lockstep {

class PacketForger {
public:
    /// packets: Ethernet frames with IPv4 and UDP, from PacketTap; those that are not of DDS are left out.
    PacketForger(const std::vector<std::string>& packets, unsigned seed);

    /// The number of packets to choose from.
    std::size_t size() const { return packets_.size(); }
    /// One of the packets: unchanged, with sequence numbers far ahead, another sender, or another lease.
    std::string next();

private:
    void advance_sequence_numbers(std::string& packet);
    void change_sender(std::string& packet);
    void change_lease(std::string& packet);
    std::size_t below(std::size_t limit) { return random_() % limit; }

    std::vector<std::string> packets_;
    std::mt19937_64 random_;
};

}  // namespace lockstep
