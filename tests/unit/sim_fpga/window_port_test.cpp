#include "services/axis/window_port.hpp"

#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

TEST(WindowPort, AReadingOfADeviceWithItsOwnClockHasTheIntervalInWhichItWasMade) {
    DeviceBench bench;
    Tick host{1'000'000};
    const auto host_clock = [&] {
        host += Ticks{7};
        (void)bench.at(bench.device.now() + Ticks{5});  // reading the registers takes this time
        return host;
    };
    WindowPort port(DeviceDriver::attach(bench.window, kTick_ns).value(), host_clock);
    EXPECT_EQ(port.clock(), DeviceClock::Own);
    const DeviceReading reading = port.read(Tick{0}).value().value();
    EXPECT_EQ(reading.asked, Tick{1'000'007});
    EXPECT_EQ(reading.answered, Tick{1'000'014});
    EXPECT_EQ(reading.status.now, Tick{5}) << "read in between";
}

/// So motors of devices with different delays step together.
TEST(WindowPort, TheClockOfADeviceIsTheTickAtItsPins) {
    DeviceBench bench(bench_axis(), {.behind = Ticks{40}});
    (void)bench.at(Tick{100});
    WindowPort port(DeviceDriver::attach(bench.window, kTick_ns).value(), [] { return Tick{1'000'000}; });
    const DeviceReading reading = port.read(Tick{0}).value().value();
    EXPECT_EQ(reading.status.now, Tick{100});
    EXPECT_EQ(exchange_of(reading).received, Tick{60});
}

TEST(WindowPort, AReadingOfADeviceThatIsHeldUpKeepsItsAge) {
    DeviceBench bench;
    (void)bench.at(Tick{5});
    WindowPort port(DeviceDriver::attach(bench.window, kTick_ns).value());
    EXPECT_EQ(port.clock(), DeviceClock::Host);
    EXPECT_EQ(port.read(Tick{100}).value()->asked, Tick{100});
    bench.window.store(registers::kSequence, 7);
    EXPECT_EQ(port.read(Tick{200}).value()->asked, Tick{100}) << "in the middle of an update";
    (void)bench.at(Tick{8});
    EXPECT_EQ(port.read(Tick{300}).value()->asked, Tick{300});
}

TEST(WindowPort, ASimulatedDeviceRunsUpToThePresentWhenItIsRead) {
    const auto port = simulated_port({}, bench_axis(), kStart).value();
    EXPECT_EQ(port->clock(), DeviceClock::Host);
    EXPECT_EQ(port->read(kStart).value()->status.now, kStart);
    EXPECT_EQ(port->read(kStart + Ticks{500}).value()->status.now, kStart + Ticks{500});
}

TEST(WindowPort, ADeviceThatCannotDoWhatTheMotorNeedsIsRefusedAndNotEnabled) {
    const RegisterWindow window = RegisterWindow::in_process();
    SimulatedDevice device(window, Plant(bench_axis(), kTick_ns), kTick_ns, Tick{}, 0, {.segment_entries = 256});
    const auto driver = attach_driver(window, {}, bench_axis());
    ASSERT_FALSE(driver);
    EXPECT_NE(driver.error().find("its segment ring has 256 entries"), std::string::npos) << driver.error();
    EXPECT_EQ(window.load(registers::kEnable), 0u);
    EXPECT_EQ(window.load(registers::kSetupRequest), 0u);
}

TEST(WindowPort, SetsTheDeviceUpForTheMotor) {
    const RegisterWindow window = RegisterWindow::in_process();
    SimulatedDevice device(window, Plant(bench_axis(), kTick_ns), kTick_ns, Tick{});
    MotorConfig motor = bench_axis();
    motor.pins = {.step_width_us = 2.5, .enable_inverted = true};
    ASSERT_TRUE(attach_driver(window, {}, motor));
    device.advance(Tick{10});
    EXPECT_EQ(load_setup(window, DeviceAbilities{}.time_unit_ps),
              (DeviceSetup{.step_width_ns = 2500, .enable_inverted = true}));
    EXPECT_EQ(window.load(registers::kSetup), window.load(registers::kSetupRequest));
}

TEST(WindowPort, SaysHowMuchRoomTheDeviceHadForSteps) {
    DeviceBench bench;
    WindowPort port(DeviceDriver::attach(bench.window, kTick_ns).value());
    bench.order(device::BeginRun{1});
    bench.order(last_frame(1));
    bench.order(device::Arm{1});
    (void)bench.at(kMuchLater);
    int steps = 0;
    const auto count = [&](StepEdge) { ++steps; };
    EXPECT_EQ(port.drain(count).value(), DeviceAbilities{}.capture_entries - 10);
    EXPECT_EQ(port.drain(count).value(), DeviceAbilities{}.capture_entries);
    EXPECT_EQ(steps, 10);
}

}  // namespace
}  // namespace lockstep
