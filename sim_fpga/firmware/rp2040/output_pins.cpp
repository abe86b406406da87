#include "sim_fpga/firmware/rp2040/output_pins.hpp"

#include "sim_fpga/firmware/rp2040/chip.hpp"
#include "sim_fpga/firmware/rp2040/pin_program.hpp"
#include "sim_fpga/firmware/rp2040/waiting_words.hpp"

namespace lockstep::firmware {

using namespace chip;

namespace {

constexpr unsigned kFirstPin = 22, kPins = 7;  // the machine writes seven pins, of which four are connected to it
constexpr std::uint32_t kOutputWords = 256;    // of blocks that wait: at most 17 words each
static_assert((kWaitingBlocks + 1) * (kRenderTicks / kLeastOutputTicks + 1) <= kOutputWords);

constexpr std::uint32_t kOutPins = 0x6000 | kPins;
constexpr std::uint32_t kOutTicks = 0x6020 | (32 - kPins);
constexpr std::uint32_t kPinsLow = 0xA003;  // MOV PINS, NULL

/// 25 cycles of 40 ns a tick, for X + 1 ticks.
constexpr std::uint32_t kOutputInstructions[] = {
    lasting(kOutPins, 5),                                    // 240 ns
    lasting(kOutTicks, 5),                                   // 240 ns
    lasting(jump_if_x_is_0(kOutputProgram), 12),             // 520 ns
    lasting(jump_if_x_counts_down(kOutputProgram + 2), 11),  // 480 ns: always, because X is not 0
};

constinit WaitingWords<kOutputWords> waiting_changes;

constexpr std::uint32_t machine() { return pio0::machine(kOutputMachine); }

bool is_before(std::uint32_t one, std::uint32_t other) { return static_cast<std::int32_t>(one - other) < 0; }
std::uint32_t later(std::uint32_t one, std::uint32_t other) { return is_before(one, other) ? other : one; }

std::uint32_t pins_of(std::size_t motor, std::uint32_t outputs) {
    std::uint32_t pins = 0;
    for (unsigned n = 0; n < kOutputs[motor].count; ++n) {
        if ((outputs >> n & 1) != 0) { pins |= bit(kOutputs[motor].pins[n] - kFirstPin); }
    }
    return pins;
}

}  // namespace

/// The motors' machines are kLeastStepTicks late.
void OutputPins::show(std::size_t motor, std::int64_t tick, std::uint16_t levels) {
    insert({static_cast<std::uint32_t>(tick) + kLeastStepTicks, pins_of(motor, 3), pins_of(motor, levels)});
}

/// If there is no room, the change happens with the last one.
void OutputPins::insert(const Change& change) {
    if (size_ == kMostChanges) {
        Change& last = changes_[size_ - 1];
        last.levels = (last.levels & ~change.pins) | change.levels;
        last.pins |= change.pins;
        return;
    }
    std::size_t n = size_++;
    for (; n > 0 && is_before(change.at, changes_[n - 1].at); --n) { changes_[n] = changes_[n - 1]; }
    changes_[n] = change;
}

void OutputPins::queue_block(std::int64_t now) {
    const std::uint32_t end = static_cast<std::uint32_t>(now) + kRenderTicks;
    while (size_ > 0) {
        const std::uint32_t time = later(changes_[0].at, changed_ + kLeastOutputTicks);
        if (!is_before(time, end)) { break; }
        hold(time);
        apply_until(time);
        changed_ = time;
    }
    hold(end);
    changed_ = later(changed_, end - kLeastOutputTicks);  // so that it stays near enough to compare
}

void OutputPins::hold(std::uint32_t until) {
    if (until == held_) { return; }
    waiting_changes.put(levels_ << (32 - kPins) | (until - held_ - 1));
    held_ = until;
}

void OutputPins::apply_until(std::uint32_t time) {
    std::size_t done = 0;
    for (; done < size_ && !is_before(time, changes_[done].at); ++done) {
        levels_ = (levels_ & ~changes_[done].pins) | changes_[done].levels;
    }
    size_ -= done;
    for (std::size_t n = 0; n < size_; ++n) { changes_[n] = changes_[n + done]; }
}

void connect_outputs() {
    unsigned n = kOutputProgram;
    for (const std::uint32_t instruction : kOutputInstructions) { at(pio0::instruction(n++)) = instruction; }
    at(machine() + pio0::kDivider) = kDividerOf200MHz << 16;
    at(machine() + pio0::kShift) = bit(30) | bit(17);  // one queue of 8 words; taken by itself, highest bit first
    for (const MotorOutputs& outputs : kOutputs) {
        for (unsigned k = 0; k < outputs.count; ++k) { connect_pin(machine(), outputs.pins[k], io::kPio0); }
    }
    at(machine() + pio0::kPins) = kPins << 20 | kFirstPin;
    at(machine() + pio0::kExecute) = jump(kOutputProgram);
}

void invert_outputs(std::size_t motor, std::uint16_t inverted) {
    for (unsigned n = 0; n < kOutputs[motor].count; ++n) {
        at(io::control(kOutputs[motor].pins[n])) = io::kPio0 | ((inverted >> n & 1) != 0 ? io::kInverted : 0);
    }
}

void feed_outputs() { waiting_changes.feed(0, kOutputMachine); }

void switch_outputs_off() { at(machine() + pio0::kExecute) = kPinsLow; }

}  // namespace lockstep::firmware
