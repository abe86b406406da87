#include "sim_fpga/firmware/rp2040/step_pins.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/registers.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr std::uint32_t kAllMachines = (1U << kMotors) - 1;
constexpr std::uint32_t kWaitingWords = kWaitingBlocks * kWordsPerBlock;
constexpr std::uint32_t kEachDirectionBit = 0xAAAA'AAAA;

/// Instructions of a machine. Each shows the step pin's level for 1 + `delay` of its cycles.
constexpr std::uint32_t timed(std::uint32_t instruction, std::uint32_t step, std::uint32_t delay) {
    return instruction | step << 12 | delay << 8;
}
constexpr std::uint32_t kOutPin = 0x6001;  // a bit to the direction pin
constexpr std::uint32_t kOutX = 0x6021;    // a bit to X
constexpr std::uint32_t jump(std::uint32_t to) { return to; }
constexpr std::uint32_t jump_if_x_is_0(std::uint32_t to) { return 1 << 5 | to; }
constexpr std::uint32_t kSetPinsOutput = 0xE081;
constexpr std::uint32_t kSetPinsLow = 0xE000;

/// 25 cycles of 40 ns a tick.
constexpr std::uint32_t kProgram[] = {
    timed(kOutPin, 0, 11),           // 0: 480 ns
    timed(kOutX, 0, 1),              // 1: 80 ns
    timed(jump_if_x_is_0(4), 0, 0),  // 2: 40 ns
    timed(jump(0), 1, 9),            // 3: 400 ns
    timed(jump(0), 0, 9),            // 4: 400 ns
};
constexpr std::uint32_t kDividerOf125MHz = 5;

// Words that wait. The execution of ticks alone writes them and `queued_words`, feed_machines() alone `fed_words`.
std::uint32_t waiting[kMotors][kWaitingWords];
volatile std::uint32_t queued_words;
volatile std::uint32_t fed_words;

/// The machines take words together, and the last one is fed last.
bool machines_have_room() { return (at(pio0::kLevels) >> 8 * (kMotors - 1) & 15) < kMachineWords; }

void load_program() {
    unsigned n = 0;
    for (const std::uint32_t instruction : kProgram) { at(pio0::instruction(n++)) = instruction; }
}

/// Makes a pin an output of a machine, at the low level.
void connect_pin(std::uint32_t machine, unsigned pin) {
    at(machine + pio0::kPins) = 1U << 26 | pin << 5;  // one pin for SET
    at(machine + pio0::kExecute) = kSetPinsOutput;
    at(machine + pio0::kExecute) = kSetPinsLow;
    at(io::control(pin)) = io::kPio0;
}

void connect_motor(std::size_t motor) {
    const std::uint32_t machine = pio0::machine(static_cast<unsigned>(motor));
    at(machine + pio0::kDivider) = kDividerOf125MHz << 16;
    at(machine + pio0::kShift) = bit(30) | bit(17);  // one queue of 8 words; taken by itself, highest bit first
    connect_pin(machine, step_pin(motor));
    connect_pin(machine, direction_pin(motor));
    at(machine + pio0::kPins) = 1U << 29 | 1U << 20 | step_pin(motor) << 10 | direction_pin(motor);
    at(io::control(enable_pin(motor))) = io::kSio;
    at(sio::kOutputEnable) = bit(enable_pin(motor));
    for (unsigned pin = first_input_pin(motor); pin < first_input_pin(motor + 1); ++pin) {
        at(pads::pin(pin)) = pads::kInput;
        at(io::control(pin)) = io::kSio;
    }
}

}  // namespace

void MotorPins::begin_block(std::int64_t now) {
    block_ = now;
    for (std::uint32_t& word : words_) { word = is_forward_ ? kEachDirectionBit : 0; }
}

void MotorPins::look() { pins_ = at(sio::kInputs) >> first_input_pin(motor_) & 7; }

void MotorPins::step(std::int64_t tick, int direction) {
    const auto n = static_cast<std::uint32_t>(tick - block_ - 1);
    const std::uint32_t pair = 30 - n % kTicksPerWord * 2;  // the lower bit of the tick's two
    std::uint32_t word = n / kTicksPerWord;
    words_[word] |= std::uint32_t{1} << pair;
    if ((direction > 0) == is_forward_) { return; }
    is_forward_ = direction > 0;
    words_[word] ^= kEachDirectionBit & (~std::uint32_t{0} >> (30 - pair));
    while (++word < kWordsPerBlock) { words_[word] ^= kEachDirectionBit; }
}

void MotorPins::queue_block() const {
    std::uint32_t at = queued_words;
    for (const std::uint32_t word : words_) { waiting[motor_][at++ % kWaitingWords] = word; }
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

void stop_step_pins() { at(pio0::kControl) = 0; }

bool have_room_for_block() { return queued_words - fed_words <= kWaitingWords - kWordsPerBlock; }

void finish_block() { queued_words = queued_words + kWordsPerBlock; }

void feed_machines() {
    while (fed_words != queued_words && machines_have_room()) {
        const std::uint32_t word = fed_words % kWaitingWords;
        for (std::size_t motor = 0; motor < kMotors; ++motor) {
            at(pio0::transmit(static_cast<unsigned>(motor))) = waiting[motor][word];
        }
        fed_words = fed_words + 1;
    }
}

bool have_run_dry() { return (at(pio0::kDebug) >> 24 & kAllMachines) != 0; }

}  // namespace lockstep::firmware
