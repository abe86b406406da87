// The firmware of a Raspberry Pi Pico.
#include "sim_fpga/firmware/rp2040/board.hpp"
#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/firmware/rp2040/clocks.hpp"

inline void* operator new(std::size_t, void* place) noexcept { return place; }

namespace lockstep::firmware {
namespace {

using namespace chip;

constexpr unsigned kRenderInterrupt = 0;
constexpr std::uint32_t kRenderPeriod_us = 16;

alignas(Board) unsigned char board_memory[sizeof(Board)];
Board& board() { return *reinterpret_cast<Board*>(board_memory); }

/// Never 0: that is no session.
std::uint32_t random_word() {
    std::uint32_t word = at(timer::kNow);
    for (int n = 0; n < 32; ++n) { word = word << 1 ^ word >> 31 ^ (at(ring_oscillator::kRandomBit) & 1); }
    return word | 1;
}

void set_alarm() { at(timer::kAlarm0) = at(timer::kNow) + kRenderPeriod_us; }

void start_rendering() {
    board().render();
    board().enter();
    start_step_pins();
    at(timer::kInterrupts) = 1;
    set_alarm();
    at(nvic::priority(kRenderInterrupt)) = nvic::priority_bits(kRenderInterrupt, 0);
    at(nvic::kEnable) = bit(kRenderInterrupt);
    board().leave();
}

}  // namespace

extern "C" void on_render_time() {
    at(timer::kRaised) = 1;
    set_alarm();
    board().render();
}

extern "C" int main() {
    start_clocks();
    connect_step_pins();
    new (board_memory) Board(random_word());
    start_rendering();
    start_uart();
    for (;;) { board().serve_link(); }
}

}  // namespace lockstep::firmware
