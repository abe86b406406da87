// The two ways to connect a sender: TCP, and a pseudo-terminal in place of a serial line.
#pragma once

#include <expected>
#include <optional>
#include <string>

#include "clients/channel/bytes.hpp"

namespace lockstep::grbl {

/// Accepts a waiting connection; nullopt if none waits.
std::optional<Descriptor> accept_from(const Descriptor& listener);
/// The address of the other side; empty if not known.
std::string peer_of(const Descriptor& connection);

/// A pseudo-terminal and a symbolic link to it. The destructor removes the link.
class Terminal {
public:
    static std::expected<Terminal, std::string> open(const std::string& link);
    Terminal(Terminal&& other) noexcept;
    Terminal& operator=(Terminal&&) = delete;
    ~Terminal();
    const Descriptor& descriptor() const { return master_; }
    /// Whether a process has the terminal open.
    bool is_used() const;

private:
    Terminal(Descriptor master, std::string link) : master_(std::move(master)), link_(std::move(link)) {}
    Descriptor master_;
    std::string link_;
};

}  // namespace lockstep::grbl
