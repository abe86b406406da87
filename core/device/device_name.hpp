// Where an axis finds its device: the key `device` of the machine's file, read once.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

struct DeviceName {
    enum class Kind : std::uint8_t {
        Simulated,  // "sim": in the process of its axis
        Shared,     // "shm:NAME": a lockstep-fpga on the same host, by the name of its shared memory
        Mapped,     // "uio:PATH": hardware with the register map, by the absolute path that maps it; for tests a file
        Linked,     // "board:NAME/N": motor N of a board behind a link that lockstep-board holds on the same host
    };
    Kind kind = Kind::Simulated;
    std::string place;    // NAME or PATH; empty for Simulated
    unsigned number = 0;  // N; 0 for the other kinds

    /// Hardware counts the ticks of its own oscillator, for which frames must leave room. Simulated devices count those
    /// of the host's clock, and so does a process that maps a file.
    bool has_own_clock() const { return kind == Kind::Mapped || kind == Kind::Linked; }
    /// Whether it is one of a board behind a link.
    bool is_of_board(std::string_view board) const { return kind == Kind::Linked && place == board; }
    /// As in the machine's file.
    std::string text() const;
    bool operator==(const DeviceName&) const = default;
};

/// The most motors that the devices of a board may have numbers for, from 0 on.
inline constexpr unsigned kMostBoardMotors = 16;
inline constexpr std::string_view kDeviceNames = "sim, shm:NAME, uio:PATH or board:NAME/N";
/// Returns nullopt if the text is none of kDeviceNames.
std::optional<DeviceName> read_device_name(std::string_view text);

}  // namespace lockstep
