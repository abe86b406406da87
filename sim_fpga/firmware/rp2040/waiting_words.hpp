// Words that wait in memory for one of the machines that time the pins.
#pragma once

#include <cstdint>

#include "sim_fpga/firmware/rp2040/chip.hpp"

namespace lockstep::firmware {

/// The execution of ticks alone puts words, the interrupt that feeds the machines alone feeds them.
template <std::uint32_t kRoom>
class WaitingWords {
public:
    /// There must be room.
    void put(std::uint32_t word) {
        words_[queued_ % kRoom] = word;
        queued_ = queued_ + 1;
    }
    /// Gives words to a machine, as many as it takes. `pio`: its block's distance behind the first one's registers.
    void feed(std::uint32_t pio, unsigned machine) {
        std::uint32_t fed = fed_;
        for (const std::uint32_t queued = queued_; fed != queued && has_room(pio, machine); ++fed) {
            chip::at(pio + chip::pio0::transmit(machine)) = words_[fed % kRoom];
        }
        fed_ = fed;
    }

private:
    static constexpr std::uint32_t kMachineWords = 8;
    static bool has_room(std::uint32_t pio, unsigned machine) {
        return (chip::at(pio + chip::pio0::kLevels) >> 8 * machine & 15) < kMachineWords;
    }

    std::uint32_t words_[kRoom]{};
    volatile std::uint32_t queued_ = 0;
    volatile std::uint32_t fed_ = 0;
};

}  // namespace lockstep::firmware
