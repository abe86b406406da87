// The registers of the RP2040 that the firmware uses, by the names of its datasheet.
#pragma once

#include <cstdint>

namespace lockstep::firmware::chip {

inline volatile std::uint32_t& at(std::uint32_t address) {
    return *reinterpret_cast<volatile std::uint32_t*>(static_cast<std::uintptr_t>(address));
}
/// The address at which writing sets, or clears, the bits of a register.
constexpr std::uint32_t set_bits(std::uint32_t address) { return address + 0x2000; }
constexpr std::uint32_t clear_bits(std::uint32_t address) { return address + 0x3000; }
constexpr std::uint32_t bit(unsigned n) { return std::uint32_t{1} << n; }

inline void wait_for(std::uint32_t address, std::uint32_t bits) {
    while ((at(address) & bits) != bits) {}
}

namespace clocks {
inline constexpr std::uint32_t kRefControl = 0x4000'8030, kRefSelected = 0x4000'8038;
inline constexpr std::uint32_t kSysControl = 0x4000'803C, kSysSelected = 0x4000'8044;
inline constexpr std::uint32_t kPeripheralControl = 0x4000'8048, kUsbControl = 0x4000'8054;
}  // namespace clocks
namespace resets {
inline constexpr std::uint32_t kReset = 0x4000'C000, kDone = 0x4000'C008;
inline constexpr std::uint32_t kIoBank = bit(5), kPads = bit(8), kPio0 = bit(10), kPio1 = bit(11), kPllSys = bit(12),
                               kPllUsb = bit(13), kTimer = bit(21), kUart0 = bit(22), kUsb = bit(24);
}  // namespace resets
namespace io {
/// The control register of a pin.
constexpr std::uint32_t control(unsigned pin) { return 0x4001'4004 + 8 * pin; }
inline constexpr std::uint32_t kUart = 2, kSio = 5, kPio0 = 6, kPio1 = 7;
inline constexpr std::uint32_t kInverted = bit(8);
}  // namespace io
namespace pads {
constexpr std::uint32_t pin(unsigned n) { return 0x4001'C004 + 4 * n; }
/// 4 mA, with hysteresis, read, pulled low.
inline constexpr std::uint32_t kInput = 0x56;
}  // namespace pads
namespace crystal {
inline constexpr std::uint32_t kControl = 0x4002'4000, kStatus = 0x4002'4004, kStartup = 0x4002'400C;
}  // namespace crystal
/// A PLL's registers, from its first one on.
namespace pll {
inline constexpr std::uint32_t kSys = 0x4002'8000, kUsb = 0x4002'C000;
inline constexpr std::uint32_t kControl = 0x00, kPower = 0x04, kFeedback = 0x08, kPostDividers = 0x0C;
}  // namespace pll
namespace uart0 {
inline constexpr std::uint32_t kDataByte = 0x4003'4000, kFlags = 0x4003'4018, kWholeDivider = 0x4003'4024,
                               kFraction = 0x4003'4028, kLine = 0x4003'402C, kControl = 0x4003'4030,
                               kInterrupts = 0x4003'4038, kClear = 0x4003'4044;
inline constexpr std::uint32_t kReceiveEmpty = bit(4), kTransmitFull = bit(5);
inline constexpr std::uint32_t kReceive = bit(4), kReceiveTimeout = bit(6);
}  // namespace uart0
namespace timer {
constexpr std::uint32_t alarm(unsigned n) { return 0x4005'4010 + 4 * n; }
inline constexpr std::uint32_t kNow = 0x4005'4028, kRaised = 0x4005'4034, kInterrupts = 0x4005'4038;
}  // namespace timer
namespace watchdog {
inline constexpr std::uint32_t kTick = 0x4005'802C;
}  // namespace watchdog
namespace ring_oscillator {
inline constexpr std::uint32_t kRandomBit = 0x4006'001C;
}  // namespace ring_oscillator
namespace regulator {
inline constexpr std::uint32_t kControl = 0x4006'4000;
inline constexpr std::uint32_t kEnabled = bit(0), k1150mV = 12U << 4;
}  // namespace regulator
namespace flash_line {
inline constexpr std::uint32_t kControl = 0x1800'0000, kEnable = 0x1800'0008, kDivider = 0x1800'0014,
                               kStatus = 0x1800'0028, kData = 0x1800'0060;
inline constexpr std::uint32_t kHasReceived = bit(3);
}  // namespace flash_line
namespace usb_memory {
inline constexpr std::uint32_t kBegin = 0x5010'0000, kBytes = 4096;
/// The control registers of endpoint n, from 1 on, and the control words of buffers, from 0 on.
constexpr std::uint32_t in_end(unsigned n) { return kBegin + 8 * n; }
constexpr std::uint32_t out_end(unsigned n) { return kBegin + 8 * n + 4; }
constexpr std::uint32_t in_buffers(unsigned n) { return kBegin + 0x80 + 8 * n; }
constexpr std::uint32_t out_buffers(unsigned n) { return kBegin + 0x84 + 8 * n; }
inline constexpr std::uint32_t kEnabled = bit(31), kTwoBuffers = bit(30), kEachBuffer = bit(29), kBulk = 2U << 26,
                               kInterrupt = 3U << 26;
}  // namespace usb_memory
namespace usb_controller {
inline constexpr std::uint32_t kAddress = 0x5011'0000, kMainControl = 0x5011'0040, kControl = 0x5011'004C,
                               kStatus = 0x5011'0050, kBuffersDone = 0x5011'0058, kRefusesControl = 0x5011'0068,
                               kMuxing = 0x5011'0074, kPower = 0x5011'0078;
inline constexpr std::uint32_t kEachControlBuffer = bit(29), kPullUp = bit(16);
inline constexpr std::uint32_t kBusReset = bit(19), kHasSetup = bit(17);
inline constexpr std::uint32_t kToTransceiver = bit(0), kConnected = bit(3);
inline constexpr std::uint32_t kOverridesPower = bit(2), kHasPower = bit(3);
}  // namespace usb_controller
namespace pio0 {
inline constexpr std::uint32_t kControl = 0x5020'0000, kDebug = 0x5020'0008, kLevels = 0x5020'000C;
constexpr std::uint32_t transmit(unsigned machine) { return 0x5020'0010 + 4 * machine; }
constexpr std::uint32_t instruction(unsigned n) { return 0x5020'0048 + 4 * n; }
/// The registers of a machine.
constexpr std::uint32_t machine(unsigned n) { return 0x5020'00C8 + 0x18 * n; }
inline constexpr std::uint32_t kDivider = 0x00, kShift = 0x08, kExecute = 0x10, kPins = 0x14;
}  // namespace pio0
/// The second block's registers are so far behind those of the first one.
inline constexpr std::uint32_t kPio1 = 0x10'0000;
namespace sio {
inline constexpr std::uint32_t kInputs = 0xD000'0004, kSet = 0xD000'0014, kClear = 0xD000'0018,
                               kOutputEnable = 0xD000'0024;
}  // namespace sio
namespace nvic {
inline constexpr std::uint32_t kEnable = 0xE000'E100;
/// The register with the priority of an interrupt, and its bits; 0 is the highest of four.
constexpr std::uint32_t priority(unsigned interrupt) { return 0xE000'E400 + interrupt / 4 * 4; }
constexpr std::uint32_t priority_bits(unsigned interrupt, std::uint32_t level) {
    return level << (interrupt % 4 * 8 + 6);
}
}  // namespace nvic

}  // namespace lockstep::firmware::chip
