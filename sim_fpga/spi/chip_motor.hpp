// A register window as if a motor of the chip behind the SPI wrote it: what the chip shows is copied there, and what
// the host writes there is copied to the chip.
//
// The chip keeps few steps. So their ticks are taken off its ring at each look, and the window's ring has as many
// entries as the map allows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <span>
#include <vector>

#include "sim_fpga/firmware/host/host_words.hpp"
#include "sim_fpga/register_window.hpp"
#include "sim_fpga/spi/chip_spi.hpp"

namespace lockstep::spi {

/// A word of the host at an address that the register map leaves free. The chip clears it at power-up, as all words of
/// the host. Then a host stores the number there that it drew for POWER_UP.
inline constexpr std::size_t kSessionWord = 0x11F8;

class ChipMotor {
public:
    using Now = std::function<std::int64_t()>;  // CLOCK_MONOTONIC in ns

    /// window: of zeros. number: of the motor on the chip. draw: a number that is not 0, and new each time.
    ChipMotor(RegisterWindow window, unsigned number, Now now, std::function<std::uint64_t()> draw);

    /// Copies what the chip shows. If the chip is new, or was powered up again, this first sets both sides' words to
    /// those of the chip. Returns false if the chip does not answer.
    [[nodiscard]] bool look(ChipSpi& chip);
    /// Copies what the host has written. look() must have succeeded. Returns false if the chip does not answer; what
    /// was not copied is copied the next time.
    [[nodiscard]] bool obey(ChipSpi& chip);
    /// As MotorOrders::show_link().
    void show_link(bool answers) { orders_.show_link(answers); }
    /// Whether the chip has this motor and the register map of these programs.
    bool is_connected() const { return is_connected_; }

private:
    struct Words {
        std::size_t offset;
        std::vector<std::uint64_t> values;
    };
    /// A ring that the device writes, how many entries the chip's and the window's have, and how many entries the
    /// window has got so far.
    struct Ring {
        std::size_t offset;
        std::size_t entry_bytes;
        std::uint64_t entries = 0;
        std::uint64_t shown = 0;
        std::uint64_t taken = 0;
    };

    bool connect(ChipSpi& chip);
    bool is_shown(ChipSpi& chip);
    bool begin_after_power_up(ChipSpi& chip);
    bool take_over(ChipSpi& chip);
    bool look_at_words(ChipSpi& chip);
    bool show_foreign(std::span<const std::uint64_t> constants);
    void take(std::size_t offset, std::span<const std::uint64_t> words);
    void publish(std::int64_t asked);
    bool take_ring(ChipSpi& chip, Ring& ring, std::uint64_t head);
    bool take_captures(ChipSpi& chip, std::uint64_t head);
    void fill();
    void add(std::size_t offset, std::uint64_t value);

    RegisterWindow window_;
    firmware::MotorOrders orders_;
    unsigned number_;
    Now now_;
    std::function<std::uint64_t()> draw_;
    bool is_connected_ = false;
    std::uint64_t session_ = 0;   // of the chip's power-up whose words these are; 0: of none
    std::uint64_t sequence_ = 0;  // that was shown last
    std::uint64_t tick_ = 0;
    std::uint64_t armed_ = 0;         // as the chip has it
    std::uint64_t capture_tail_ = 0;  // as the chip has it
    Ring captures_{registers::kCaptureRing, registers::kCaptureRingEntryBytes};
    Ring events_{registers::kEventRing, registers::kEventRingEntryBytes};
    std::deque<Words> pending_;  // to be written
};

}  // namespace lockstep::spi
