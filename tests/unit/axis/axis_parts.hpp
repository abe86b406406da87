// The condition of an axis and a device written by hand, for tests of the axis's parts.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "core/axis/state/axis_loop.hpp"
#include "tests/unit/axis/pair_machine.hpp"

namespace lockstep {

class AxisParts : public testing::Test {
protected:
    static MachineConfig machine() { return pair_machine(); }

    /// A device at rest that has ended its newest run and has room for everything.
    DeviceStatus at_rest() const {
        DeviceStatus status{.now = now, .position = rest_position(0, false)};
        status.power_up = 5;
        status.run = status.run_asked = device.newest_run();
        status.finished = true;
        status.free_segments = 1000;
        return status;
    }
    void show(const DeviceStatus& status, bool is_resting = false) {
        (void)device.appear();
        device.see(status, is_resting);
    }
    void make_ready() {
        condition.position.set_zero(0, device.status());
        condition.phases.happen(AxisEvent::PositionKept);
    }
    AxisLoop loop() {
        out = {};
        return {now, now.value / 1000, now.value / 1000, condition, device, out};
    }
    template <typename Order>
    std::ptrdiff_t ordered() const {
        return std::ranges::count_if(out.orders, [](const auto& o) { return std::holds_alternative<Order>(o); });
    }
    bool noticed(AxisNotice::Kind kind) const { return std::ranges::count(out.notices, kind, &AxisNotice::kind) != 0; }

    Tick now{100'000};
    AxisCondition condition{.phases = {},
                            .position = {machine(), MotorIndex{0}, std::unexpected(FaultCode::PositionNotKept)},
                            .orders = {}};
    DeviceView device;
    AxisOutputs out;
};

}  // namespace lockstep
