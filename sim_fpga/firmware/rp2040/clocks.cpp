#include "sim_fpga/firmware/rp2040/clocks.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr std::uint32_t kCrystal_mhz = 12;

void start_crystal() {
    at(crystal::kControl) = 0xAA0;                  // 1 to 15 MHz
    at(crystal::kStartup) = 47;                     // 1 ms, in 256 periods
    at(set_bits(crystal::kControl)) = 0xFAB << 12;  // the number that enables it
    wait_for(crystal::kStatus, bit(31));
}

void end_reset(std::uint32_t parts) {
    at(clear_bits(resets::kReset)) = parts;
    wait_for(resets::kDone, parts);
}

/// 12 MHz x 125 / 6 / 2.
void start_pll() {
    end_reset(resets::kPllSys);
    at(pll_sys::kControl) = 1;
    at(pll_sys::kFeedback) = 125;
    at(clear_bits(pll_sys::kPower)) = bit(0) | bit(5);  // the PLL and its oscillator
    wait_for(pll_sys::kControl, bit(31));
    at(pll_sys::kPostDividers) = 6 << 16 | 2 << 12;
    at(clear_bits(pll_sys::kPower)) = bit(3);
}

}  // namespace

void start_clocks() {
    start_crystal();
    start_pll();
    at(clocks::kRefControl) = 2;  // the crystal
    wait_for(clocks::kRefSelected, bit(2));
    at(clocks::kSysControl) = 0;  // the reference, while the other source changes to the PLL
    wait_for(clocks::kSysSelected, bit(0));
    at(clocks::kSysControl) = 1;
    wait_for(clocks::kSysSelected, bit(1));
    at(clocks::kPeripheralControl) = bit(11);
    at(watchdog::kTick) = bit(9) | kCrystal_mhz;
    end_reset(resets::kIoBank | resets::kPads | resets::kPio0 | resets::kTimer | resets::kUart0);
}

}  // namespace lockstep::firmware
