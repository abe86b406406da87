// The line to a board: bytes through a serial port or a TCP connection. No function waits longer than for the opening
// of a connection to this host.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>

#include "core/device/link_name.hpp"
#include "services/files/descriptor.hpp"
#include "sim_fpga/firmware/link/frame.hpp"

namespace lockstep {

class LinkLine {
public:
    /// A serial line runs at 1 MBd. Error: why it cannot be opened, and the remedy.
    static std::expected<LinkLine, std::string> open(const LinkName& name);
    /// Takes a connection that is open and does not block.
    explicit LinkLine(Descriptor line) : line_(std::move(line)) {}

    /// Waits until bytes arrive, at most so long.
    void wait(int most_ms) const;
    /// The bytes that have arrived, valid until the next call. nullopt: the line is gone.
    std::optional<std::span<const std::uint8_t>> receive();
    /// Whether the bytes sent before have left, but for a few: only then is the next frame made, so that it has the
    /// newest words.
    bool is_free();
    /// is_free() must hold.
    void send(const firmware::Frame& frame);

private:
    void flush();

    Descriptor line_;
    firmware::Frame frame_;
    std::size_t sent_ = 0;  // bytes of frame_
    std::array<std::uint8_t, 4096> received_{};
};

}  // namespace lockstep
