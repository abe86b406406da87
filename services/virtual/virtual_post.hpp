// The addresses of a virtual machine, and the messages between them. Each axis's process, each coordinator and the
// client has an address. Each process has a second address for clock messages, which it answers on arrival, not in its
// loop.
#pragma once

#include <memory>
#include <utility>

#include "services/virtual/mail.hpp"
#include "services/virtual/virtual_fault.hpp"

namespace lockstep {

class VirtualPost {
public:
    VirtualPost(const NetworkBehaviour& behaviour, std::uint64_t seed, std::size_t axes, std::size_t coordinators)
        : network_(behaviour, seed), axes_(axes), processes_(axes + coordinators) {
        network_.trust(address(client()));
    }

    std::size_t processes() const { return processes_; }
    bool is_coordinator(std::size_t process) const { return process >= axes_; }
    /// The first coordinator, which axes ask for the time.
    std::size_t coordinator() const { return axes_; }
    std::size_t client() const { return processes_; }
    std::size_t clock_of(std::size_t process) const { return client() + 1 + process; }

    template <typename Message>
    void send(Tick now, std::size_t from, std::size_t to, const Message& message) {
        post(now, from, to, std::make_shared<const VirtualMessage>(message));
    }
    /// Sends to every process and the client, except the sender.
    template <typename Message>
    void multicast(Tick now, std::size_t from, const Message& message) {
        const auto shared = std::make_shared<const VirtualMessage>(message);
        for (std::size_t to = 0; to <= client(); ++to) {
            if (to != from) { post(now, from, to, shared); }
        }
    }
    /// Sends to every axis.
    void send_to_axes(Tick now, std::size_t from, const Frame& frame) {
        const auto shared = std::make_shared<const VirtualMessage>(frame);
        for (std::size_t to = 0; to < axes_; ++to) { post(now, from, to, shared); }
    }

    /// Returns the messages that have arrived at `to` since its last call. Valid until the next call for any address.
    Mail& collect(Tick now, std::size_t to) {
        mail_.collect(network_, now, to);
        return mail_;
    }
    Tick next_arrival(std::size_t to) const { return network_.next_arrival(address(to)); }

    /// Cuts the links that the fault names, for clock messages too. restore() undoes it.
    void cut(const VirtualFault& fault) { apply(fault, true); }
    void restore(const VirtualFault& fault) { apply(fault, false); }

    const AlterationCounts& alterations() const { return network_.alterations(); }

private:
    static VirtualNetwork::Address address(std::size_t of) { return static_cast<VirtualNetwork::Address>(of); }
    void post(Tick now, std::size_t from, std::size_t to, SharedMessage message) {
        network_.send(now, address(from), address(to), std::move(message));
    }
    void apply(const VirtualFault& fault, bool cuts);

    VirtualNetwork network_;
    Mail mail_;
    std::size_t axes_;
    std::size_t processes_;
};

}  // namespace lockstep
