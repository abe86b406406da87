#include "sim_fpga/firmware/rp2040/boot_mode.hpp"

#include <cstdint>

namespace lockstep::firmware {
namespace {

// The boot ROM's list of functions, and its function that finds one of them by two letters (RP2040 datasheet, 2.8.3).
constexpr std::uintptr_t kListAt = 0x14, kFindAt = 0x18;
constexpr std::uint32_t kResetToUsbBoot = 'U' | 'B' << 8;

using Find = void* (*)(const std::uint16_t* list, std::uint32_t letters);
using ResetToUsbBoot = void (*)(std::uint32_t busy_pins, std::uint32_t left_out);

std::uintptr_t half_word(std::uintptr_t address) { return *reinterpret_cast<volatile std::uint16_t*>(address); }

}  // namespace

/// The ROM resets all parts of the chip: the pins of drivers become inputs.
void enter_boot_mode() {
    asm volatile("cpsid i" ::: "memory");
    const auto find = reinterpret_cast<Find>(half_word(kFindAt));
    const auto* const list = reinterpret_cast<const std::uint16_t*>(half_word(kListAt));
    reinterpret_cast<ResetToUsbBoot>(find(list, kResetToUsbBoot))(0, 0);
    for (;;) {}
}

}  // namespace lockstep::firmware
