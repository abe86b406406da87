// The two ways in which a sender connects: TCP, and a pseudo-terminal in place of a serial line.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "clients/channel/descriptor.hpp"

namespace lockstep::grbl {

/// Listens there. Error: the address cannot be used, and why.
std::expected<Descriptor, std::string> listen_at(const std::string& address, std::uint16_t port);
/// Whether a connection waits.
bool has_waiting(const Descriptor& listener);
/// A connection that waits; nothing: none does.
std::optional<Descriptor> accept_from(const Descriptor& listener);
/// The address of the other side; empty: it is not known.
std::string peer_of(const Descriptor& connection);

/// A pseudo-terminal, with a symbolic link to it that is removed with the object.
class Terminal {
public:
    static std::expected<Terminal, std::string> open(const std::string& link);
    Terminal(Terminal&& other) noexcept;
    Terminal& operator=(Terminal&&) = delete;
    ~Terminal();
    const Descriptor& descriptor() const { return master_; }
    /// A process has it open.
    bool is_used() const;

private:
    Terminal(Descriptor master, std::string link) : master_(std::move(master)), link_(std::move(link)) {}
    Descriptor master_;
    std::string link_;
};

}  // namespace lockstep::grbl
