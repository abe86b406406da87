// A device and a driver share registers that the fuzzer overwrites between their turns. Neither reads or writes outside
// the registers, and the driver refuses values that it cannot interpret with a text.
#include <cstdint>
#include <cstring>
#include <span>

#include "core/kinematics/motors.hpp"
#include "services/axis/device_driver.hpp"
#include "sim_fpga/device.hpp"
#include "tests/fuzz/require.hpp"

namespace lockstep {
namespace {

MotorConfig axis() {
    MotorConfig axis{.name = "X", .steps_per_mm = 100, .start_velocity_mm_s = 10, .max_velocity_mm_s = 100};
    axis.position_max_mm = 100;
    axis.plant = {.start_position_mm = 50, .travel_margin_mm = 2, .max_torque_accel_mm_s2 = 1500, .max_jump_mm_s = 15};
    return axis;
}

struct Turn {
    std::uint8_t kind;
    std::uint8_t small;
    std::uint16_t offset;
    std::int64_t value;
};

class Bench {
public:
    Bench() : device_(window_, Plant(axis(), 1000), 1000, Tick{0}) {}

    void take(const Turn& turn) {
        switch (turn.kind % 4) {
            case 0:
                window_.store(turn.offset * 8U % registers::kWindowBytes, static_cast<std::uint64_t>(turn.value));
                break;
            case 1: device_.advance(now_ += Ticks{turn.offset}); break;
            case 2: order(turn); break;
            default: look(); break;
        }
    }

private:
    void look() {
        auto driver = DeviceDriver::attach(window_, 1000);
        if (!driver) { return require(!driver.error().empty(), "a refusal has a text"); }
        const auto status = driver->read();
        require(status || !status.error().empty(), "a refusal has a text");
        const auto drained = driver->drain_capture([](StepEdge) {});
        require(drained || !drained.error().empty(), "a refusal has a text");
        const auto events = driver->drain_events([](const ChannelEvent&) {});
        require(events || !events.error().empty(), "a refusal has a text");
    }
    void order(const Turn& turn) {
        auto driver = DeviceDriver::attach(window_, 1000);
        if (!driver) { return; }
        (void)driver->set_up({});
        switch (turn.small % 5) {
            case 0: (void)driver->apply(device::BeginRun{++run_, static_cast<Trigger>(turn.small / 4 % 3)}); break;
            case 1: (void)driver->apply(device::Arm{turn.offset}); break;
            case 2: (void)driver->apply(device::Veto{turn.offset}); break;
            case 3: (void)driver->apply(outputs(turn)); break;
            default: (void)driver->apply(load(turn)); break;
        }
    }
    static device::LoadOutputs outputs(const Turn& turn) {
        device::LoadOutputs order{.number = turn.offset % 8U, .track = {}};
        for (int i = 0; i <= turn.small / 64; ++i) {
            order.track.body.append({{turn.small + i}, RampAnalog{turn.kind, turn.value, turn.value / 1000}});
            order.track.tail.append({{turn.small + i}, SetDigital{turn.kind, turn.small}});
        }
        return order;
    }
    device::LoadFrame load(const Turn& turn) {
        device::LoadFrame frame{
            .number = turn.offset % 8U, .start = now_ + Ticks{turn.small}, .last = false, .track = {}};
        for (int i = 0; i <= turn.small / 64; ++i) {
            (void)frame.track.body.push_back({{turn.small + 1}, {turn.value}, {turn.value / 1000}});
        }
        return frame;
    }

    RegisterWindow window_ = RegisterWindow::in_process();
    SimulatedDevice device_;
    Tick now_;
    std::uint64_t run_ = 0;
};

}  // namespace
}  // namespace lockstep

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace lockstep;
    constexpr std::size_t kBytes = 12;
    Bench bench;
    for (std::span<const std::uint8_t> left(data, size); left.size() >= kBytes; left = left.subspan(kBytes)) {
        Turn turn{};
        std::memcpy(&turn.kind, left.data(), 1);
        std::memcpy(&turn.small, left.data() + 1, 1);
        std::memcpy(&turn.offset, left.data() + 2, 2);
        std::memcpy(&turn.value, left.data() + 4, 8);
        bench.take(turn);
    }
    return 0;
}
