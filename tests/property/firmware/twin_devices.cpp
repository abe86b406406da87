#include "tests/property/firmware/twin_devices.hpp"

#include <sstream>

#include "core/hardware/output_change.hpp"
#include "core/protocol/messages.hpp"
#include "core/step/executable.hpp"

namespace lockstep::testing {
namespace {

// The firmware has copies of these numbers, because the headers of core need integers of 128 bits.
static_assert(firmware::kMostPieces == kMaxBodyPieces + 1 + kMaxTailPieces + 1);
static_assert(firmware::kMostBodyChanges == OutputTrack::kMostInBody);
static_assert(firmware::kMostTailChanges == OutputTrack::kMostInTail);
static_assert(firmware::kLongestPiece == kMaxPieceTicks.value);

DeviceAbilities abilities_of(const firmware::Abilities& abilities) {
    return {.segment_entries = firmware::kSegmentRoom,
            .capture_entries = firmware::kCaptureRoom,
            .least_step = {static_cast<std::int64_t>(abilities.least_step_ticks)},
            .lead = {static_cast<std::int64_t>(abilities.lead_ticks)},
            .behind = {static_cast<std::int64_t>(abilities.pin_ticks)},
            .time_unit_ps = abilities.time_unit_ps,
            .longest_time = abilities.longest_time,
            .longest_pwm_period = abilities.longest_pwm_period,
            .inputs = abilities.inputs,
            .digital_outputs = abilities.digital_outputs,
            .analog_outputs = abilities.analog_outputs,
            .output_entries = firmware::kOutputRoom,
            .event_entries = firmware::kEventRoom,
            .has_encoder = abilities.has_encoder,
            .can_enable = abilities.can_enable,
            .can_compare = abilities.can_compare};
}

}  // namespace

TwinDevices::TwinDevices(const MotorConfig& motor, const firmware::Abilities& abilities, Tick now)
    : port_(Plant(motor, kTwinTick_ns)),
      simulated_(std::make_unique<SimulatedDevice>(window_, Plant(motor, kTwinTick_ns), kTwinTick_ns, now,
                                                   abilities.power_up, abilities_of(abilities))),
      firmware_(std::make_unique<firmware::Device>(port_, abilities, now.value)) {}

std::optional<std::string> TwinDevices::difference() const {
    const auto ring = [&](std::size_t offset, std::size_t entries, std::size_t bytes) {
        return difference_in(offset, offset + entries * bytes);
    };
    if (auto found = difference_in(0, firmware::kDeviceWordsEnd)) { return found; }
    if (auto found = ring(registers::kEventRing, firmware::kEventRoom, registers::kEventRingEntryBytes)) {
        return found;
    }
    for (std::size_t n = 0; n < firmware::kMostAnalog; ++n) {
        const auto word = load(n < 4 ? registers::kAnalogLower : registers::kAnalogUpper);
        const Tick now{static_cast<std::int64_t>(load(registers::kTick))};
        if (static_cast<std::uint64_t>(port_.shown(n, now)) >> 47 != (word >> (n % 4 * 16) & 0xFFFF)) {
            return "the port shows another analog value than the words do";
        }
    }
    if (port_.shown() != load(registers::kOutputs)) { return "the port shows other outputs than the word OUTPUTS"; }
    return ring(registers::kCaptureRing, firmware::kCaptureRoom, registers::kCaptureRingEntryBytes);
}

std::optional<std::string> TwinDevices::difference_in(std::size_t begin, std::size_t end) const {
    for (std::size_t offset = begin; offset < end; offset += 8) {
        const std::uint64_t simulated = window_.load(offset);
        const std::uint64_t firmware = firmware_->words().load(offset);
        if (simulated == firmware) { continue; }
        std::ostringstream text;
        text << std::hex << "the word at 0x" << offset << " is 0x" << simulated << " in the simulated device and 0x"
             << firmware << " in the firmware";
        return text.str();
    }
    return std::nullopt;
}

}  // namespace lockstep::testing
