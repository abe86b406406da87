#include "sim_fpga/firmware/rp2040/clocks.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr std::uint32_t kCrystal_mhz = 12;

/// A clock of 200 MHz needs it (RP2040 datasheet, 2.15.3). It settles while the crystal starts.
void raise_core_voltage() { at(regulator::kControl) = regulator::kEnabled | regulator::k1150mV; }

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

/// The crystal x feedback / first / second.
void start_pll(std::uint32_t one, std::uint32_t feedback, std::uint32_t first, std::uint32_t second) {
    at(one + pll::kControl) = 1;
    at(one + pll::kFeedback) = feedback;
    at(clear_bits(one + pll::kPower)) = bit(0) | bit(5);  // the PLL and its oscillator
    wait_for(one + pll::kControl, bit(31));
    at(one + pll::kPostDividers) = first << 16 | second << 12;
    at(clear_bits(one + pll::kPower)) = bit(3);
}

}  // namespace

void start_clocks() {
    raise_core_voltage();
    start_crystal();
    end_reset(resets::kPllSys | resets::kPllUsb);
    start_pll(pll::kSys, 100, 6, 1);  // 200 MHz
    start_pll(pll::kUsb, 100, 5, 5);  // 48 MHz
    at(clocks::kRefControl) = 2;      // the crystal
    wait_for(clocks::kRefSelected, bit(2));
    at(clocks::kSysControl) = 0;  // the reference, while the other source changes to the PLL
    wait_for(clocks::kSysSelected, bit(0));
    at(clocks::kSysControl) = 1;
    wait_for(clocks::kSysSelected, bit(1));
    at(clocks::kPeripheralControl) = bit(11);
    at(clocks::kUsbControl) = bit(11);
    at(watchdog::kTick) = bit(9) | kCrystal_mhz;
    end_reset(resets::kIoBank | resets::kPads | resets::kPio0 | resets::kPio1 | resets::kTimer | resets::kUart0 |
              resets::kUsb);
}

}  // namespace lockstep::firmware
