// When a board has looked at a motor's registers: a word that the board sends behind them. It stands at an address that
// the register map leaves free.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sim_fpga/registers.hpp"

namespace lockstep::firmware {

inline constexpr std::size_t kLookWord = 0x7'0000;
static_assert(registers::kEventRing + registers::kEventRingMostEntries * registers::kEventRingEntryBytes <= kLookWord);
static_assert(kLookWord + 0x1000 <= registers::kCaptureRing);

struct LookTime {
    std::uint32_t heard;   // the newest time of the other end that had arrived at the look, in microseconds
    std::uint32_t behind;  // the ticks that the board's clock had counted beyond TICK at the look

    constexpr std::uint64_t word() const { return std::uint64_t{behind} << 32 | heard; }
    static constexpr LookTime of(std::uint64_t word) {
        return {static_cast<std::uint32_t>(word), static_cast<std::uint32_t>(word >> 32)};
    }
};

}  // namespace lockstep::firmware
