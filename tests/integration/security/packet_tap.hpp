// Takes down every UDP packet on lo as it goes by, and can send them all again, as one could on a cable. Needs root,
// and a network of its own.
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

    /// False: no raw sockets here.
    bool works() const { return socket_ >= 0; }
    /// Ends listening; the packets so far, each once.
    const std::vector<std::string>& stop();
    /// The same, once it has ended.
    const std::vector<std::string>& packets() const { return packets_; }
    /// False: it did not go out whole.
    bool send(const std::string& packet) const;
    /// Sends them again, in their order. How many went out.
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
