// The firmware of a Raspberry Pi Pico.
#include "sim_fpga/firmware/rp2040/board.hpp"
#include "sim_fpga/firmware/rp2040/boot_mode.hpp"
#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/firmware/rp2040/clocks.hpp"
#include "sim_fpga/firmware/rp2040/flash_id.hpp"
#include "sim_fpga/firmware/rp2040/output_pins.hpp"
#include "sim_fpga/firmware/rp2040/pwm_pins.hpp"
#include "sim_fpga/firmware/rp2040/uart.hpp"
#include "sim_fpga/firmware/rp2040/usb_line.hpp"
#include "sim_fpga/registers.hpp"

inline void* operator new(std::size_t, void* place) noexcept { return place; }

namespace lockstep::firmware {
namespace {

using namespace chip;

// Alarm n of the timer is interrupt n. The pins come first, then the line's bytes (uart.cpp), then the ticks.
constexpr unsigned kFeedAlarm = 0;
constexpr unsigned kRenderAlarm = 1;
constexpr std::uint32_t kFeedPeriod_us = 32;
constexpr std::uint32_t kRenderPeriod_us = 64;

alignas(Board) unsigned char board_memory[sizeof(Board)];
Board& board() { return *reinterpret_cast<Board*>(board_memory); }

/// Never 0: that is no session.
std::uint32_t random_word() {
    std::uint32_t word = at(timer::kNow);
    for (int n = 0; n < 32; ++n) { word = word << 1 ^ word >> 31 ^ (at(ring_oscillator::kRandomBit) & 1); }
    return word | 1;
}

void repeat(unsigned alarm, std::uint32_t period_us) {
    at(timer::kRaised) = bit(alarm);
    at(timer::alarm(alarm)) = at(timer::kNow) + period_us;
}

void start_alarm(unsigned alarm, std::uint32_t period_us, std::uint32_t priority) {
    at(set_bits(timer::kInterrupts)) = bit(alarm);
    at(nvic::priority(alarm)) = at(nvic::priority(alarm)) | nvic::priority_bits(alarm, priority);
    repeat(alarm, period_us);
    at(nvic::kEnable) = bit(alarm);
}

void start_motors() {
    board().render();
    feed_machines();
    board().enter();
    start_step_pins();
    board().begin_clock();
    start_alarm(kFeedAlarm, kFeedPeriod_us, 0);
    start_alarm(kRenderAlarm, kRenderPeriod_us, 2);
    board().leave();
}

}  // namespace

/// If a machine has run dry, the motors are no longer together: they stop, and the host is told.
extern "C" void on_feed_time() {
    repeat(kFeedAlarm, kFeedPeriod_us);
    if (have_run_dry()) {
        stop_step_pins();
        board().lose_ticks();
    }
    feed_machines();
}

extern "C" void on_render_time() {
    repeat(kRenderAlarm, kRenderPeriod_us);
    board().render();
}

extern "C" int main() {
    start_clocks();
    connect_step_pins();
    connect_outputs();
    connect_pwm();
    const std::uint64_t flash = read_flash_id();
    UartLine uart;
    UsbLine usb(flash != 0 ? flash : registers::kMapChecksumValue);
    new (board_memory) Board(random_word(), uart, usb);
    start_motors();
    uart.start();
    usb.start();
    for (;;) {
        usb.serve();
        if (usb.takes_boot_request() && !board().is_any_enabled()) { enter_boot_mode(); }
        board().show_light();
        if (!board().serve_link()) { asm volatile("wfi"); }  // the render's alarm ends it, at the latest
    }
}

}  // namespace lockstep::firmware
