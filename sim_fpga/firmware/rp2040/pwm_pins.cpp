#include "sim_fpga/firmware/rp2040/pwm_pins.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/firmware/rp2040/pin_program.hpp"
#include "sim_fpga/firmware/rp2040/waiting_words.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr std::uint32_t kPwmMachines = (1U << kPwmOutputs) - 1;
constexpr std::uint32_t kPwmTick_ns = 1000, kCyclesPerTick = 25;
constexpr std::uint32_t kPeriodWords = 64;  // of blocks that wait
static_assert((kWaitingBlocks + 1) * (kRenderTicks / kLeastPwmTicks + 1) <= kPeriodWords);

constexpr std::uint32_t kOutHigh = 0x6030, kOutLow = 0x6050;  // 16 bits each
constexpr std::uint32_t kPinHigh = 0xE001, kPinLow = 0xE000;

constexpr std::uint32_t kPeriod[] = {
    kOutHigh,                  // 0
    kOutLow,                   // 1
    jump_if_x_is_0(6),         // 2: off
    kPinHigh,                  // 3
    jump_if_x_counts_down(4),  // 4: X + 1 times
    jump_if_y_is_0(0),         // 5: full scale, so the pin stays high
    kPinLow,                   // 6
    jump_if_y_counts_down(7),  // 7: Y + 1 times
    jump(0),                   // 8
};
// Cycles that a period takes beside X and Y, and what of them is high.
constexpr std::uint32_t kOffCycles = 6, kFullCycles = 6, kPartCycles = 9, kHighCycles = 3;

constinit WaitingWords<kPeriodWords> waiting_periods[kPwmOutputs];

constexpr std::uint32_t machine(unsigned output) { return kPio1 + pio0::machine(output); }

/// The nearest number of high cycles that a period can have: X and Y are at least 1.
std::uint32_t period_word(std::int64_t value, std::uint32_t ticks) {
    constexpr unsigned kUnshownBits = 46;  // of 62
    const std::uint32_t cycles = ticks * kCyclesPerTick;
    const std::uint32_t high = (static_cast<std::uint32_t>(value >> kUnshownBits) * cycles + 0x8000) >> 16;
    constexpr std::uint32_t kLeastHigh = kHighCycles + 1;
    constexpr std::uint32_t kLeastLow = kPartCycles - kHighCycles + 1;
    if (high < kLeastHigh / 2) { return cycles - kOffCycles; }
    if (cycles - high <= kLeastLow / 2) { return (cycles - kFullCycles) << 16; }
    const std::uint32_t most = cycles - kLeastLow;
    const std::uint32_t part = high < kLeastHigh ? kLeastHigh : high < most ? high : most;
    return (part - kHighCycles) << 16 | (cycles - part - (kPartCycles - kHighCycles));
}

}  // namespace

/// If there is no room, the last change is lost.
void PwmPins::show(std::size_t motor, const Ramp& ramp) {
    Output& output = outputs_[motor];
    if (output.size == kMostChanges) { --output.size; }
    output.changes[output.size++] = ramp;
}

void PwmPins::set_period(std::size_t motor, std::uint64_t ns) {
    std::uint32_t ticks = ns == 0 ? kUsualPwmTicks : kLeastPwmTicks;
    while (ticks < kMostPwmTicks && ns != 0 && ticks * kPwmTick_ns < ns) { ++ticks; }
    outputs_[motor].ticks = ticks;
}

void PwmPins::Output::follow(std::int64_t tick) {
    std::size_t done = 0;
    for (; done < size && changes[done].since <= tick; ++done) { shown = changes[done]; }
    if (done == 0) { return; }
    size -= done;
    for (std::size_t n = 0; n < size; ++n) { changes[n] = changes[n + done]; }
}

/// The motors' machines are kLeastStepTicks late.
void PwmPins::queue_block(std::int64_t now) {
    for (std::size_t n = 0; n < kPwmOutputs; ++n) {
        for (Output& output = outputs_[n]; output.next < now + kRenderTicks; output.next += output.ticks) {
            const std::int64_t tick = output.next - kLeastStepTicks;
            output.follow(tick);
            waiting_periods[n].put(period_word(output.shown.at(tick), output.ticks));
        }
    }
}

void connect_pwm() {
    unsigned at_instruction = 0;
    for (const std::uint32_t instruction : kPeriod) { at(kPio1 + pio0::instruction(at_instruction++)) = instruction; }
    for (unsigned n = 0; n < kPwmOutputs; ++n) {
        at(machine(n) + pio0::kDivider) = kDividerOf200MHz << 16;
        at(machine(n) + pio0::kShift) = bit(30) | bit(17);  // one queue of 8 words; taken by itself, highest bit first
        connect_pin(machine(n), kPwmPins[n], io::kPio1);
    }
}

void start_pwm() {
    at(kPio1 + pio0::kDebug) = ~std::uint32_t{0};
    at(kPio1 + pio0::kControl) = kPwmMachines << 8 | kPwmMachines << 4 | kPwmMachines;
}

void feed_pwm() {
    for (unsigned n = 0; n < kPwmOutputs; ++n) { waiting_periods[n].feed(kPio1, n); }
}

bool has_pwm_run_dry() { return (at(kPio1 + pio0::kDebug) >> 24 & kPwmMachines) != 0; }

void stop_pwm() {
    at(kPio1 + pio0::kControl) = 0;
    for (unsigned n = 0; n < kPwmOutputs; ++n) { at(machine(n) + pio0::kExecute) = kPinLow; }
}

}  // namespace lockstep::firmware
