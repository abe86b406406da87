#include "tests/simulation/simtest/draw/machine/draw_rings.hpp"

#include <algorithm>
#include <bit>

#include "core/coordinator/path/touched_outputs.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/frame_room.hpp"
#include "tests/simulation/simtest/draw/draw.hpp"

namespace lockstep::simtest {

MachineConfig with_small_rings(std::uint64_t seed, MachineConfig machine) {
    Draw draw(seed ^ 0x5ea11006e5000000U);
    ProtocolTiming& t = machine.timing;
    t.segment_entries = static_cast<int>(draw.magnitude(kLeastSegmentEntries, 700));
    t.frame_slots = least_frame_slots(t) + static_cast<int>(draw.whole(0, draw.chance(0.5) ? 4 : 30));
    return machine;
}

/// A device's rings have a power of two entries.
void give_rings(std::uint64_t seed, Scenario& scenario) {
    constexpr std::uint64_t kLeastDeviceEntries = 16;
    Draw draw(seed ^ 0x06e506e506e506e5U);
    ProtocolTiming& t = scenario.machine.timing;
    const auto least = std::max<std::size_t>(2 * TouchedOutputs::least_room(scenario.machine.outputs), 8);
    t.output_entries = frames_ahead(t) * static_cast<int>(draw.magnitude(static_cast<double>(least), 100));
    const OutputRoom outputs = output_room(t);
    const auto changes = static_cast<std::uint64_t>(frames_ahead(t)) * (outputs.body + outputs.tail);
    const auto entries = [&](std::uint64_t needed) {
        return std::bit_ceil(std::max(needed, kLeastDeviceEntries)) << draw.index(3);
    };
    for (std::size_t m = 0; m < motor_count(scenario.machine); ++m) {
        DeviceAbilities device;
        device.segment_entries = entries(static_cast<std::uint64_t>(needed_entries(t)));
        device.output_entries = std::min(entries(changes), device.output_entries);
        scenario.devices.push_back(device);
    }
}

}  // namespace lockstep::simtest
