#include "core/hardware/device_abilities.hpp"

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"
#include "core/protocol/frame_room.hpp"

namespace lockstep {
namespace {

/// The speed that plans reach at most, in parts of the fastest that a device can make.
constexpr double kPlannedPart = kMaxPlannedStepsPerTick / kMaxStepsPerTick;

constexpr double kPlanRounding = 1e-12;

double fastest_steps_per_tick(const MachineConfig& machine, const MotorConfig& motor) {
    return motor.max_velocity_mm_s * motor.steps_per_mm / machine.ticks_per_second();
}

/// For how long a process may stall: then the device keeps the ticks of all steps.
double longest_gap_ticks(const MachineConfig& machine) {
    return static_cast<double>(machine.slot_ticks().value) * (machine.timing.stall_slots + 1);
}

std::string text_of(std::uint64_t number) { return std::to_string(number); }

}  // namespace

DeviceAbilities needs_of(const MachineConfig& machine, const MotorConfig& motor) {
    const double speed = fastest_steps_per_tick(machine, motor);
    const std::size_t frame =
        kFrameHeaders + static_cast<std::size_t>(body_pieces(machine.timing)) + kMaxTailPieces + kDevicePieces;
    return {.segment_entries = static_cast<std::uint64_t>(frames_ahead(machine.timing)) * frame,
            .capture_entries = static_cast<std::uint64_t>(std::ceil(speed * longest_gap_ticks(machine))),
            .least_step = {
                static_cast<std::int64_t>(std::min(std::floor(kPlannedPart / speed * (1 + kPlanRounding)), 1e9))}};
}

std::optional<std::string> lack_of(const DeviceAbilities& device, const MachineConfig& machine,
                                   const MotorConfig& motor) {
    const DeviceAbilities needs = needs_of(machine, motor);
    if (device.segment_entries < needs.segment_entries) {
        return "device: its segment ring has " + text_of(device.segment_entries) +
               " entries, and the frames that are sent ahead need " + text_of(needs.segment_entries) +
               "; increase timing.frame_slots, or use a device with more";
    }
    if (device.capture_entries < needs.capture_entries) {
        return "device: it records the ticks of " + text_of(device.capture_entries) + " steps, and motor " +
               motor.name + " makes up to " + text_of(needs.capture_entries) +
               " while its process stalls; decrease max_velocity_mm_s, timing.slot_us or timing.stall_slots";
    }
    if (device.least_step > needs.least_step) {
        const double most_mm_s = kPlannedPart / static_cast<double>(device.least_step.value) *
                                 machine.ticks_per_second() / motor.steps_per_mm;
        return "device: it needs " + std::to_string(device.least_step.value) +
               " ticks from one step to the next; max_velocity_mm_s of motor " + motor.name + " must be at most " +
               number_text(most_mm_s) + ", or decrease its steps_per_mm";
    }
    return std::nullopt;
}

}  // namespace lockstep
