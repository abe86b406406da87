#include "sim_fpga/firmware/rp2040/step_pins.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/firmware/rp2040/output_pins.hpp"
#include "sim_fpga/firmware/rp2040/pin_program.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr std::uint32_t kAllMachines = (1U << (kMotors + 1)) - 1;
constexpr std::uint32_t kWaitingWords = kWaitingBlocks * kWordsPerBlock;
constexpr std::uint32_t kEachDirectionBit = 0xAAAA'AAAA;
constexpr std::uint32_t kEachStepBit = 0x5555'5555;
constexpr std::uint32_t kTick_ns = 1000;

constexpr std::uint32_t kOutPin = 0x6001;  // a bit to the direction pin
constexpr std::uint32_t kOutX = 0x6021;    // a bit to X
constexpr std::uint32_t kSetPinsOutput = 0xE081;
constexpr std::uint32_t kSetPinsLow = 0xE000;
constexpr std::uint32_t kSetPinsHigh = 0xE001;

/// 25 cycles of 40 ns a tick.
constexpr std::uint32_t kProgram[] = {
    lasting(kOutPin, 12),      // 0: 520 ns
    kOutX,                     // 1: 40 ns
    jump_if_x_is_0(5),         // 2: 40 ns
    lasting(kSetPinsHigh, 8),  // 3: 360 ns
    jump(0),                   // 4: 40 ns
    lasting(kSetPinsLow, 8),   // 5: 360 ns
    jump(0),                   // 6: 40 ns
};
static_assert(sizeof kProgram / sizeof kProgram[0] == kOutputProgram);

// Words that wait. The execution of ticks alone writes them and `queued_words`, feed_machines() alone `fed_words`.
std::uint32_t waiting[kMotors][kWaitingWords];
volatile std::uint32_t queued_words;
volatile std::uint32_t fed_words;

/// So many ticks are at least so long. Without a division, for which the processor has no instruction.
std::uint32_t ticks_of(std::uint32_t ns) {
    std::uint32_t ticks = 0;
    while (ticks * kTick_ns < ns) { ++ticks; }
    return ticks;
}

/// The machines take words together, and the last one is fed last.
bool machines_have_room() { return (at(pio0::kLevels) >> 8 * (kMotors - 1) & 15) < kMachineWords; }

void load_program() {
    unsigned n = 0;
    for (const std::uint32_t instruction : kProgram) { at(pio0::instruction(n++)) = instruction; }
}

void connect_motor(std::size_t motor) {
    const std::uint32_t machine = pio0::machine(static_cast<unsigned>(motor));
    at(machine + pio0::kDivider) = kDividerOf125MHz << 16;
    at(machine + pio0::kShift) = bit(30) | bit(17);  // one queue of 8 words; taken by itself, highest bit first
    connect_pin(machine, step_pin(motor));
    connect_pin(machine, direction_pin(motor));
    at(machine + pio0::kPins) = 1U << 26 | step_pin(motor) << 5 | 1U << 20 | direction_pin(motor);
    at(io::control(enable_pin(motor))) = io::kSio;
    at(sio::kOutputEnable) = bit(enable_pin(motor));
    for (unsigned pin = first_input_pin(motor); pin < first_input_pin(motor + 1); ++pin) {
        at(pads::pin(pin)) = pads::kInput;
        at(io::control(pin)) = io::kSio;
    }
}

}  // namespace

void connect_pin(std::uint32_t machine, unsigned pin) {
    at(machine + pio0::kPins) = 1U << 26 | pin << 5;  // one pin for SET
    at(machine + pio0::kExecute) = kSetPinsOutput;
    at(machine + pio0::kExecute) = kSetPinsLow;
    at(io::control(pin)) = io::kPio0;
}

void MotorPins::begin_block(std::int64_t now) {
    block_ = now;
    words_[0] = words_[kWordsPerBlock];
    words_[1] = words_[kWordsPerBlock + 1];
    for (std::uint32_t n = 2; n < kWordsPerBlock + 2; ++n) { words_[n] = is_forward_ ? kEachDirectionBit : 0; }
}

void MotorPins::look() { pins_ = at(sio::kInputs) >> first_input_pin(motor_) & 7; }

void MotorPins::step(std::int64_t tick, int direction) {
    const bool turns = (direction > 0) != is_forward_;
    if (turns && tick - stepped_ < kLeastStepTicks) {
        pulse(stepped_);
        stepped_ = kLongAgo;
        return;
    }
    if (turns) { turn(tick); }
    pulse(tick);
    stepped_ = tick;
}

/// Adds the pulse of a step, or takes it back.
void MotorPins::pulse(std::int64_t tick) {
    const auto rise = static_cast<std::uint32_t>(tick - block_ - 1 + kLeastStepTicks) + delay_;
    const std::uint32_t bits = rise % kTicksPerWord * 2;
    std::uint32_t* const word = words_ + rise / kTicksPerWord;
    word[0] ^= pulse_ >> bits;
    if (const std::uint32_t rest = pulse_ << 1 << (31 - bits); rest != 0) { word[1] ^= rest; }
}

void MotorPins::show(std::int64_t tick, std::uint16_t levels) { outputs_.show(motor_, tick, levels); }

void MotorPins::turn(std::int64_t tick) {
    is_forward_ = !is_forward_;
    const auto n = static_cast<std::uint32_t>(tick - block_ - 1 + kLeastStepTicks);
    std::uint32_t word = n / kTicksPerWord;
    words_[word] ^= kEachDirectionBit & (~std::uint32_t{0} >> n % kTicksPerWord * 2);
    while (++word < kWordsPerBlock + 2) { words_[word] ^= kEachDirectionBit; }
}

void MotorPins::time(std::uint32_t width_ns, std::uint32_t direction_ns) {
    const std::uint32_t ticks = width_ns == 0 ? 1 : ticks_of(width_ns);
    pulse_ = kEachStepBit & ~(~std::uint32_t{0} >> 2 * ticks);
    delay_ = direction_ns <= kDirectionToStep_ns ? 0 : ticks_of(direction_ns - kDirectionToStep_ns);
}

void MotorPins::queue_block() const {
    std::uint32_t* const to = waiting[motor_] + queued_words % kWaitingWords;
    for (std::uint32_t n = 0; n < kWordsPerBlock; ++n) { to[n] = words_[n]; }
}

void MotorPins::show_enabled(bool is_enabled) const {
    at(is_enabled ? sio::kSet : sio::kClear) = bit(enable_pin(motor_));
}

void MotorPins::invert(std::uint64_t inverted) const {
    const auto control = [&](std::uint64_t mask) { return (inverted & mask) != 0 ? io::kInverted : 0; };
    at(io::control(step_pin(motor_))) = io::kPio0 | control(registers::kInvertedStep);
    at(io::control(direction_pin(motor_))) = io::kPio0 | control(registers::kInvertedDirection);
    at(io::control(enable_pin(motor_))) = io::kSio | control(registers::kInvertedEnable);
}

void connect_step_pins() {
    load_program();
    for (std::size_t motor = 0; motor < kMotors; ++motor) { connect_motor(motor); }
}

/// Restarts the machines and their dividers with the same write, so that their ticks begin together.
void start_step_pins() {
    at(pio0::kDebug) = ~std::uint32_t{0};
    at(pio0::kControl) = kAllMachines << 8 | kAllMachines << 4 | kAllMachines;
}

void stop_step_pins() {
    at(pio0::kControl) = 0;
    for (unsigned motor = 0; motor < kMotors; ++motor) { at(pio0::machine(motor) + pio0::kExecute) = kSetPinsLow; }
    switch_outputs_off();
}

bool have_room_for_block() { return queued_words - fed_words <= kWaitingWords - kWordsPerBlock; }

void finish_block() { queued_words = queued_words + kWordsPerBlock; }

void feed_machines() {
    std::uint32_t fed = fed_words;
    for (const std::uint32_t queued = queued_words; fed != queued && machines_have_room(); ++fed) {
        const std::uint32_t word = fed % kWaitingWords;
        for (std::size_t motor = 0; motor < kMotors; ++motor) {
            at(pio0::transmit(static_cast<unsigned>(motor))) = waiting[motor][word];
        }
    }
    fed_words = fed;
    feed_outputs();
}

bool have_run_dry() { return (at(pio0::kDebug) >> 24 & kAllMachines) != 0; }

}  // namespace lockstep::firmware
