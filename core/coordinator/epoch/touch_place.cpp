#include "core/coordinator/epoch/touch_place.hpp"

#include <algorithm>

#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

/// By how much the tick at which the pulses cease may differ from the tick of the touch and the debounce.
Ticks tolerance_of(const MachineConfig& machine, MotorIndex motor, Ticks debounce) {
    if (!estimates_clock(machine, motor)) { return Ticks{1}; }
    constexpr std::int64_t kRates = 1000;  // the clocks' rates differ by less than a thousandth
    return machine.clock_error_limit() + machine.clock_error_limit() + Ticks{1 + debounce.value / kRates};
}

}  // namespace

std::optional<OffTouch> off_touch(const MachineConfig& machine, const TouchInputs& touch, Tick touched,
                                  const RunFrames& ran, const MotorPositions& rests) {
    if (!touch.ceases || touched < ran.begin) { return std::nullopt; }
    const std::vector<MotorConfig> motors = motors_of(machine);
    for (const TouchInput& input : touch.any_of) {
        const MotorIndex m = input.motor;
        const Ticks debounce = setup_of(machine, motors[m]).debounce[input.channel];
        const Ticks off = tolerance_of(machine, m, debounce);
        const Tick ceases = touched + debounce;
        const std::int64_t before = ran.places_at(ceases - off)[m].count();
        const std::int64_t behind = ran.places_at(ceases + off)[m].count();
        const std::int64_t rest = rests[m].count();
        if (rest >= std::min(before, behind) && rest <= std::max(before, behind)) { continue; }
        return OffTouch{m, rest, ran.places_at(ceases)[m].count()};
    }
    return std::nullopt;
}

}  // namespace lockstep
