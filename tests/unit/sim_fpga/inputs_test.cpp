// Inputs follow their pins after a debounce, and a device knows tick, count and phase of each change.
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

DeviceBench bench_with(const DeviceSetup& setup) {
    return DeviceBench(endless_axis(), {}, RegisterWindow::in_process(), setup);
}

std::vector<ChannelEvent> events_of(DeviceBench& bench) {
    std::vector<ChannelEvent> seen;
    const auto result = bench.driver.drain_events([&](const ChannelEvent& event) { seen.push_back(event); });
    EXPECT_TRUE(result) << result.error();
    return seen;
}

ChannelEvent input(Tick tick, std::uint8_t channel, bool closed) {
    return {.tick = tick,
            .kind = ChannelEvent::Kind::Input,
            .channel = channel,
            .closed = closed,
            .detail = std::numeric_limits<std::int64_t>::min()};  // the phase at rest
}

void run_ten_steps(DeviceBench& bench) {
    bench.order(device::BeginRun{1});
    bench.order(last_frame(1));
    bench.order(device::Arm{1});
}

TEST(Inputs, FollowTheirPinsAtOnceWithoutADebounce) {
    DeviceBench bench;
    bench.device.plant().set_pin(5, true);
    EXPECT_EQ(bench.at(Tick{10}).inputs, 1u << 5);
    bench.device.plant().set_pin(5, false);
    EXPECT_EQ(bench.at(Tick{20}).inputs, 0u);
    EXPECT_EQ(events_of(bench), (std::vector{input(Tick{0}, 5, true), input(Tick{10}, 5, false)}));
}

TEST(Inputs, IgnoreABounceShorterThanTheirDebounce) {
    DeviceSetup setup;
    setup.debounce[3] = Ticks{100};
    DeviceBench bench = bench_with(setup);
    const auto set = [&](std::int64_t tick, bool high) {
        (void)bench.at(Tick{tick});
        bench.device.plant().set_pin(3, high);
    };
    set(1000, true);
    set(1050, false);
    set(1080, true);
    set(1200, false);
    set(1240, true);
    (void)bench.at(Tick{1260});
    EXPECT_EQ(events_of(bench), std::vector{input(Tick{1180}, 3, true)});
}

TEST(Inputs, AreClosedWhileTheirPinIsLowIfTheyAreInverted) {
    DeviceBench bench = bench_with({.inputs_inverted = 1u << 4});
    EXPECT_EQ(bench.at(Tick{10}).inputs, 1u << 4);
    bench.device.plant().set_pin(4, true);
    EXPECT_EQ(bench.at(Tick{20}).inputs, 0u);
}

TEST(Inputs, AChangeAtAStepHasItsTickItsCountAndItsPhase) {
    DeviceBench bench(endless_axis());
    bench.device.plant().put_probe(6, 4, false);
    run_ten_steps(bench);
    (void)bench.at(kMuchLater);
    const StepEdge fourth = bench.steps()[3];
    const std::vector<ChannelEvent> seen = events_of(bench);
    ASSERT_EQ(seen.size(), 1u);
    EXPECT_EQ(seen[0].tick, fourth.tick);
    EXPECT_EQ(seen[0].value, 4);
    const Position at = Position::steps(0) + Piece{fourth.tick - kStart, kBenchSpeed, {}}.covered();
    EXPECT_EQ(static_cast<std::uint64_t>(seen[0].detail), at.phase());
}

TEST(Inputs, AnyInputCanBeALimitTheHomeSwitchOrAStop) {
    for (const auto& [setup, ends] : {std::pair{DeviceSetup{.limit_max = 1u << 7}, &DeviceStatus::stopped_by_limit},
                                      std::pair{DeviceSetup{.stop = 1u << 7}, &DeviceStatus::stopped_by_input}}) {
        DeviceBench bench = bench_with(setup);
        bench.device.plant().put_probe(7, 4, false);
        run_ten_steps(bench);
        const DeviceStatus after = bench.at(kMuchLater);
        EXPECT_TRUE(after.*ends);
        EXPECT_EQ(after.position.count(), 4);
        EXPECT_EQ(bench.steps().size(), 4u);
    }
    DeviceBench home = bench_with({.home = 1u << 7});
    home.device.plant().put_probe(7, 4, false);
    home.order(device::BeginRun{1, Trigger::HomeCloses});
    home.order(last_frame(1));
    home.order(device::Arm{1});
    const DeviceStatus after = home.at(kMuchLater);
    EXPECT_TRUE(after.stopped_by_trigger);
    EXPECT_EQ(after.trigger_count, 4);
}

TEST(Inputs, AStopThatClosesBetweenStepsEndsTheRunAtItsTickAndNoRunBeginsWhileItIsClosed) {
    DeviceBench bench = bench_with({.stop = 1u << 5});
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(device::Arm{1});
    (void)bench.at(kStart + Ticks{200});
    bench.device.plant().set_pin(5, true);
    const DeviceStatus stopped = bench.at(kStart + Ticks{201});
    EXPECT_TRUE(stopped.stopped_by_input);
    EXPECT_TRUE(stopped.finished);
    EXPECT_EQ(stopped.position.count(), 2);
    device::LoadFrame again = last_frame(1);
    again.start = kStart + Ticks{5000};
    again.track.from = stopped.position;
    bench.order(device::BeginRun{2});
    bench.order(again);
    bench.order(device::Arm{1});
    const DeviceStatus still = bench.at(kMuchLater);
    EXPECT_TRUE(still.stopped_by_input);
    EXPECT_EQ(still.position.count(), 2);
}

TEST(Inputs, EventsBeyondTheRingAreCounted) {
    DeviceBench bench(endless_axis(), {.event_entries = 16});
    for (int k = 0; k < 20; ++k) {
        bench.device.plant().set_pin(5, k % 2 == 0);
        (void)bench.at(Tick{10 + k});
    }
    EXPECT_EQ(events_of(bench).size(), 16u);
    EXPECT_EQ(bench.driver.lost_events(), 4u);
}

TEST(Inputs, AnImpossibleEventIsAnErrorNotAnEvent) {
    using namespace registers;
    for (const auto& [word, value] :
         {std::pair{kEventRingTick, std::uint64_t{1'000'000}}, std::pair{kEventRingWhat, std::uint64_t{5}}}) {
        DeviceBench bench;
        bench.device.plant().set_pin(5, true);
        (void)bench.at(Tick{10});
        bench.window.store(kEventRing + word, value);
        EXPECT_FALSE(bench.driver.drain_events([](const ChannelEvent&) { FAIL(); })) << value;
    }
}

TEST(Setup, IsTakenAtRestOnlyAndNoRunBeginsBeforeTheFirst) {
    DeviceBench bench(endless_axis());
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(device::Arm{1});
    (void)bench.at(kStart + Ticks{100});
    ASSERT_TRUE(bench.driver.set_up({.inputs_inverted = 1u << 5}));
    EXPECT_EQ(bench.at(kStart + Ticks{200}).inputs, 0u) << "in motion";
    (void)bench.at(kMuchLater);
    EXPECT_EQ(bench.at(kMuchLater + Ticks{1}).inputs, 1u << 5);

    DeviceBench fresh(endless_axis());
    fresh.window.store(registers::kSetupRequest, 0);
    run_ten_steps(fresh);
    EXPECT_EQ(fresh.at(kMuchLater).position.count(), 0);
}

TEST(Setup, WaitsAfterTheMotorIsEnabled) {
    DeviceBench bench = bench_with({.enable_wait = Ticks{2000}});
    run_ten_steps(bench);
    const DeviceStatus early = bench.at(kMuchLater);
    EXPECT_EQ(early.position.count(), 0) << "the frame starts before the motor is ready";
    EXPECT_TRUE(early.bad_segment);
}

TEST(Setup, BeyondTheDeviceIsRefusedWithItsRemedy) {
    const auto error = [](const DeviceSetup& setup) {
        DeviceBench bench(bench_axis(), {.longest_time = 1000, .inputs = 3, .digital_outputs = 2, .analog_outputs = 1});
        const std::uint64_t before = bench.window.load(registers::kSetupRequest);
        const auto set = bench.driver.set_up(setup);
        EXPECT_EQ(bench.window.load(registers::kSetupRequest) != before, set.has_value());
        return set ? std::string() : set.error();
    };
    EXPECT_EQ(error({}), "");
    EXPECT_EQ(error({.stop = 1u << 3}), "device: there is no input 3; it has 3, numbered from 0");
    EXPECT_EQ(error({.compare_outputs = 4}), "device: there is no digital output 2; it has 2, numbered from 0");
    EXPECT_EQ(error({.at_cut = {.digital = {}, .analog_off = 2}}),
              "device: there is no analog output 1; it has 1, numbered from 0");
    EXPECT_EQ(error({.step_width_ns = 1001}),
              "device: pulse times can be up to 1000 ns, and one is 1001 ns; make it shorter");
}

TEST(Setup, OfTheWindowIsTheOneThatWasWritten) {
    RegisterWindow window = RegisterWindow::in_process();
    DeviceSetup setup{.step_width_ns = 2000,
                      .direction_setup_ns = 500,
                      .direction_hold_ns = 625,
                      .enable_wait = Ticks{9},
                      .step_inverted = true,
                      .enable_inverted = true,
                      .inputs_inverted = 0x80000001,
                      .limit_min = 16,
                      .limit_max = 32,
                      .home = 64,
                      .stop = 128,
                      .outputs_inverted = 3,
                      .at_cut = {{1, 3}, 2},
                      .at_silence = {{0, 0xFFFF}, 0xFF},
                      .disable_at_silence = true,
                      .silence = Ticks{100'000},
                      .compare_outputs = 0x8000,
                      .compare_pulse = Ticks{5}};
    setup.debounce[31] = Ticks{7};
    setup.pwm_period_ns[7] = 200'000;
    store_setup(window, setup, 125);
    EXPECT_EQ(load_setup(window, 125), setup);
}

TEST(Setup, RoundsPulseTimesUpToTheDevicesUnits) {
    RegisterWindow window = RegisterWindow::in_process();
    store_setup(window, {.step_width_ns = 1001}, 20'833);
    EXPECT_EQ(window.load(registers::kStepWidth), 49u) << "48 units are 999.98 ns";
}

}  // namespace
}  // namespace lockstep
