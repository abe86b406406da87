// Runs an axis in virtual time: the controller and a simulated device, loop by loop. The axis homes, then makes a move
// of its own.
//
// The controller reads no clock and sends nothing. In each loop it gets the time, its device's state and the received
// messages, and returns orders for the device and the state to publish. This example itself makes the messages of the
// owner, the coordinator.
#include <cstdio>

#include "core/axis/axis_controller.hpp"
#include "core/hardware/device_abilities.hpp"
#include "core/kinematics/motors.hpp"
#include "core/methods/paper_steps.hpp"
#include "services/axis/device_driver.hpp"
#include "sim_fpga/device.hpp"

namespace {

using namespace lockstep;

MachineConfig machine_of_one_axis() {
    AxisConfig axis{.name = "X",
                    .steps_per_mm = 100,
                    .start_velocity_mm_s = 10,
                    .max_velocity_mm_s = 100,
                    .max_accel_mm_s2 = 1000,
                    .max_decel_mm_s2 = 1000,
                    .position_max_mm = 100};
    axis.homing = {
        .search_velocity_mm_s = 10, .latch_velocity_mm_s = 2, .pulloff_mm = 1, .switch_position_mm = -1, .park_mm = 5};
    axis.plant = {.start_position_mm = 8, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 1500, .max_jump_mm_s = 15};
    MachineConfig machine{.name = "virtual"};
    machine.axes = {axis};
    return machine;
}

class VirtualAxis {
public:
    VirtualAxis()
        : device_(window_, Plant(motors_of(machine_)[0], machine_.tick_ns), machine_.tick_ns, Tick{}),
          driver_(DeviceDriver::attach(window_, machine_.tick_ns).value()),
          axis_(MotorIndex{0}, machine_, kIdentity, kConfigHash, methods::begin_steps,
                std::unexpected(FaultCode::PositionNotKept)) {
        driver_.set_up(setup_of(machine_, motors_of(machine_)[0])).value();
    }

    /// Runs loops, one in each slot, until the order is done.
    const AxisState& carry_out(AxisCommandKind kind, std::int64_t target_steps = 0) {
        const AxisCommand order{.term = kTerm, .sequence = ++orders_, .kind = kind, .target_steps = target_steps};
        do { loop(order); } while (state_.command_done < orders_);
        return state_;
    }

private:
    static constexpr Term kTerm{1, 1};
    static constexpr Identity kIdentity = 7;
    static constexpr std::uint64_t kConfigHash = 0;

    void loop(const AxisCommand& order) {
        ++slot_;
        const Tick now{slot_ * machine_.slot_ticks().value};
        const MachineState owner{.term = kTerm, .stamp = slot_, .phase = MachinePhase::Idle};
        device_.advance(now);
        const AxisOutputs& out = axis_.step({.now = now,
                                             .device = driver_.read().value(),
                                             .frames = {},
                                             .peers = {},
                                             .coordinator = {&owner, 1},
                                             .commands = {&order, 1},
                                             .requests = {},
                                             .clock_error = {}});
        for (const DeviceOrder& one : out.orders) { driver_.apply(one).value(); }
        (void)driver_.drain_capture([this](StepEdge) { ++steps_; });
        if (out.state) { report(*out.state); }
    }

    void report(const AxisState& state) {
        if (state.phase != state_.phase) {
            std::printf("%8.3f s  %-11s at %8.3f mm, %lld steps made\n", static_cast<double>(state.tick.value) * 1e-6,
                        name_of(state.phase).data(), state.position.as_steps() / 100, steps_);
        }
        state_ = state;
    }

    MachineConfig machine_ = machine_of_one_axis();
    RegisterWindow window_ = RegisterWindow::in_process();
    SimulatedDevice device_;
    DeviceDriver driver_;
    AxisController axis_;
    AxisState state_;
    Slot slot_ = 0;
    std::uint64_t orders_ = 0;
    long long steps_ = 0;
};

}  // namespace

int main() {
    VirtualAxis axis;
    if (!axis.carry_out(AxisCommandKind::Home).homed) { return 1; }
    return axis.carry_out(AxisCommandKind::MoveOwn, 6000).position.count() == 6000 ? 0 : 1;
}
