#include "sim_fpga/firmware/rp2040/step_pins.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/firmware/rp2040/output_pins.hpp"
#include "sim_fpga/firmware/rp2040/pin_program.hpp"
#include "sim_fpga/firmware/rp2040/pwm_pins.hpp"
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
    at(machine + pio0::kDivider) = kDividerOf200MHz << 16;
    at(machine + pio0::kShift) = bit(30) | bit(17);  // one queue of 8 words; taken by itself, highest bit first
    connect_pin(machine, step_pin(motor), io::kPio0);
    connect_pin(machine, direction_pin(motor), io::kPio0);
    at(machine + pio0::kPins) = 1U << 26 | step_pin(motor) << 5 | 1U << 20 | direction_pin(motor);
    at(io::control(enable_pin(motor))) = io::kSio;
    at(sio::kOutputEnable) = bit(enable_pin(motor));
    for (unsigned pin = first_input_pin(motor); pin < first_input_pin(motor + 1); ++pin) {
        at(pads::pin(pin)) = pads::kInput;
        at(io::control(pin)) = io::kSio;
    }
}

}  // namespace

void connect_pin(std::uint32_t machine, unsigned pin, std::uint32_t function) {
    at(machine + pio0::kPins) = 1U << 26 | pin << 5;  // one pin for SET
    at(machine + pio0::kExecute) = kSetPinsOutput;
    at(machine + pio0::kExecute) = kSetPinsLow;
    at(io::control(pin)) = function;
}

void MotorPins::begin_block(std::int64_t now) {
    block_ = now;
    stepped_ = stepped_ > kLongAgo ? stepped_ - static_cast<std::int32_t>(kRenderTicks) : kLongAgo;
    words_[0] = words_[kWordsPerBlock];
    words_[1] = words_[kWordsPerBlock + 1];
    for (std::uint32_t n = 2; n < kWordsPerBlock + 2; ++n) { words_[n] = is_forward_ ? kEachDirectionBit : 0; }
}

void MotorPins::look() { pins_ = at(sio::kInputs) >> first_input_pin(motor_) & 7; }

/// The step before the first one may be taken back, and the first one with it.
std::uint32_t MotorPins::step(const StepBlock& block, std::uint32_t steps) {
    const auto begin = static_cast<std::int32_t>(block.begin - block_);
    const bool is_forward = block.direction > 0;
    std::uint32_t n = 0;
    while (n < steps && is_forward != is_forward_ && !turn(begin + block.after[n])) { ++n; }
    if (n < steps) { stepped_ = begin + block.after[steps - 1]; }
    const Pulse pulse = pulse_;
    for (; n < steps; ++n) { toggle(pulse, begin + block.after[n]); }
    return steps;
}

/// Adds the pulse of a step, or takes it back.
void MotorPins::toggle(Pulse pulse, std::int32_t tick) {
    const std::uint32_t rise = static_cast<std::uint32_t>(tick - 1) + kLeastStepTicks + pulse.delay;
    const std::uint32_t bits = rise % kTicksPerWord * 2;
    std::uint32_t* const word = words_ + rise / kTicksPerWord;
    word[0] ^= pulse.bits >> bits;
    if (const std::uint32_t rest = pulse.bits << 1 << (31 - bits); rest != 0) { word[1] ^= rest; }
}

void MotorPins::show(std::int64_t tick, std::uint16_t levels) { outputs_.show(motor_, tick, levels); }

/// A motor has one analog output, or none.
void MotorPins::show_analog(std::size_t /*channel*/, const Ramp& ramp) { pwm_.show(motor_, ramp); }

/// Before a step in the other direction. Returns false if it comes too early: then the step before it is taken back.
bool MotorPins::turn(std::int32_t tick) {
    if (tick - stepped_ < static_cast<std::int32_t>(kLeastStepTicks)) {
        toggle(pulse_, stepped_);
        stepped_ = kLongAgo;
        return false;
    }
    is_forward_ = !is_forward_;
    const std::uint32_t n = static_cast<std::uint32_t>(tick - 1) + kLeastStepTicks;
    std::uint32_t word = n / kTicksPerWord;
    words_[word] ^= kEachDirectionBit & (~std::uint32_t{0} >> n % kTicksPerWord * 2);
    while (++word < kWordsPerBlock + 2) { words_[word] ^= kEachDirectionBit; }
    return true;
}

void MotorPins::time(std::uint32_t width_ns, std::uint32_t direction_ns) {
    const std::uint32_t ticks = width_ns == 0 ? 1 : ticks_of(width_ns);
    pulse_.bits = kEachStepBit & ~(~std::uint32_t{0} >> 2 * ticks);
    pulse_.delay = direction_ns <= kDirectionToStep_ns ? 0 : ticks_of(direction_ns - kDirectionToStep_ns);
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
    at(io::control(kLightPin)) = io::kSio;
    at(sio::kOutputEnable) = bit(kLightPin);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { connect_motor(motor); }
}

/// Restarts the machines and their dividers with the same write, so that their ticks begin together.
void start_step_pins() {
    at(pio0::kDebug) = ~std::uint32_t{0};
    at(pio0::kControl) = kAllMachines << 8 | kAllMachines << 4 | kAllMachines;
    start_pwm();
}

void stop_step_pins() {
    at(pio0::kControl) = 0;
    for (unsigned motor = 0; motor < kMotors; ++motor) { at(pio0::machine(motor) + pio0::kExecute) = kSetPinsLow; }
    switch_outputs_off();
    stop_pwm();
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
    feed_pwm();
}

bool have_run_dry() { return (at(pio0::kDebug) >> 24 & kAllMachines) != 0 || has_pwm_run_dry(); }

}  // namespace lockstep::firmware
