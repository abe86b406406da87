// Where an axis finds its device: the key `device` of the machine's file, read once.
#pragma once

#include <cstdint>
#include <expected>
#include <string>
#include <string_view>

namespace lockstep {

struct DeviceName {
    enum class Kind : std::uint8_t {
        Simulated,  // "sim": in the process of its axis
        Shared,     // "shm:NAME": a lockstep-fpga on the same host, by the name of its shared memory
        Mapped,     // "uio:PATH": hardware with the register map, by the absolute path that maps it
    };
    Kind kind = Kind::Simulated;
    std::string place;  // NAME or PATH; empty for Simulated

    /// Simulated devices count the ticks of the host's clock. Hardware counts those of its own oscillator.
    bool has_own_clock() const { return kind == Kind::Mapped; }
    /// As in the machine's file.
    std::string text() const;
    bool operator==(const DeviceName&) const = default;
};

/// Error: what the text must be.
std::expected<DeviceName, std::string> read_device_name(std::string_view text);

}  // namespace lockstep
