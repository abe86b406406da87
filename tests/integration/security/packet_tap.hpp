// Captures every UDP packet on lo, and can send them all again, like an attacker on a cable. Needs root,
// and its own network.
#pragma once

#include <atomic>
#include <string>
#include <thread>
#include <vector>

namespace lockstep {

class PacketTap {
public:
    PacketTap();
    ~PacketTap();
    PacketTap(const PacketTap&) = delete;
    PacketTap& operator=(const PacketTap&) = delete;

    /// False if there are no raw sockets here.
    bool works() const { return socket_ >= 0; }
    /// Ends listening. Returns the packets so far, each once.
    const std::vector<std::string>& stop();
    /// The captured packets, after listening has ended.
    const std::vector<std::string>& packets() const { return packets_; }
    /// Returns false if the packet was not sent completely.
    bool send(const std::string& packet) const;
    /// Sends them again, in their order. Returns how many were sent.
    std::size_t send_again() const;

private:
    void listen();

    int socket_;
    int sender_;
    std::atomic<bool> stopped_ = false;
    std::vector<std::string> packets_;
    std::thread listener_;
};

}  // namespace lockstep
