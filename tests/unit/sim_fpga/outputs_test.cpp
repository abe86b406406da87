// Outputs change at the ticks of their frames, with what is run of them, and fall to a safe state by themselves.
#include "sim_fpga/channel_words.hpp"
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

using Kind = ChannelEvent::Kind;

constexpr std::uint16_t kLaser = 1;
constexpr std::uint16_t kValve = 2;

OutputChange at(std::int64_t ticks, std::uint16_t levels, std::uint16_t mask) {
    return {Ticks{ticks}, SetDigital{levels, mask}};
}
OutputChange ramp(std::int64_t ticks, std::int64_t value, std::int64_t slope) {
    return {Ticks{ticks}, RampAnalog{.channel = 0, .value = value, .slope = slope}};
}

struct OutputBench : DeviceBench {
    explicit OutputBench(const DeviceSetup& setup = {})
        : DeviceBench(endless_axis(), {}, RegisterWindow::in_process(), setup) {
        order(device::BeginRun{1});
    }

    void load(const device::LoadFrame& frame, const OutputTrack& outputs) {
        order(device::LoadOutputs{frame.number, outputs});
        order(frame);
    }
    std::vector<ChannelEvent> events() {
        std::vector<ChannelEvent> seen;
        const auto result = driver.drain_events([&](const ChannelEvent& event) { seen.push_back(event); });
        EXPECT_TRUE(result) << result.error();
        return seen;
    }
};

ChannelEvent digital(Tick tick, std::uint16_t levels, std::int64_t count) {
    return {.tick = tick, .kind = Kind::Digital, .levels = levels, .value = count};
}
ChannelEvent analog(Tick tick, std::int64_t value, std::int64_t slope) {
    return {.tick = tick, .kind = Kind::Analog, .channel = 0, .value = value, .detail = slope};
}

TEST(Outputs, ChangeAtTheirTicksOfTheBodyWhateverTheCallsOfAdvance) {
    for (const std::int64_t call : {1, 7, 100'000}) {
        OutputBench bench;
        bench.load(frame(1), {{at(1, kLaser, kLaser), at(700, kValve, kValve), at(700, 0, kLaser)}, {}});
        bench.load(last_frame(2), {{at(1280, 0, kValve)}, {}});
        bench.order(device::Arm{2});
        for (Tick now; now < kMuchLater; now += Ticks{call}) { bench.device.advance(now); }
        (void)bench.at(kMuchLater);
        const std::vector<ChannelEvent> expected{
            digital(kStart + Ticks{1}, kLaser, 0), digital(kStart + Ticks{700}, kLaser | kValve, 5),
            digital(kStart + Ticks{700}, kValve, 5), digital(kStart + kBody + Ticks{1280}, 0, 20)};
        EXPECT_EQ(bench.events(), expected) << call;
    }
}

TEST(Outputs, OfALaterFrameWaitForItWhileFramesBeforeItChangeNone) {
    OutputBench bench;
    bench.load(frame(1), {{at(1, kLaser, kLaser)}, {}});
    bench.order(frame(2));
    bench.order(frame(3));
    bench.load(last_frame(4), {{at(5, 0, kLaser)}, {}});
    bench.order(device::Arm{4});
    (void)bench.at(kMuchLater);
    const auto seen = bench.events();
    ASSERT_EQ(seen.size(), 2u);
    EXPECT_EQ(seen[1].tick, kStart + kBody * 3 + Ticks{5});
}

TEST(Outputs, OfAVetoedFrameDoNotChangeAndThoseOfTheTailDo) {
    OutputBench bench;
    bench.load(frame(1), {{at(1, kLaser, kLaser)}, {at(128, 0, kLaser)}});
    bench.load(frame(2), {{at(1, kValve, kValve)}, {at(1, kValve, kValve)}});
    bench.order(device::Arm{2});
    bench.order(device::Veto{2});
    const DeviceStatus after = bench.at(kMuchLater);
    EXPECT_EQ(after.outputs, 0);
    EXPECT_EQ(after.position.count(), 11);
    const std::vector<ChannelEvent> expected{digital(kStart + Ticks{1}, kLaser, 0),
                                             digital(kStart + kBody + kTail, 0, 11)};
    EXPECT_EQ(bench.events(), expected);
}

TEST(Outputs, ThatAreAnalogAreReportedAsTheyAreAtTheTickOfTheStatus) {
    OutputBench bench;
    bench.load(last_frame(1), {{ramp(1, 0, kFullScale / 1024), {Ticks{1000}, RampAnalog{1, kFullScale, 0}}}, {}});
    bench.order(device::Arm{1});
    EXPECT_EQ(bench.at(kStart).analog, AnalogLevels{});
    EXPECT_EQ(bench.at(kStart + Ticks{1 + 512}).analog[0], kFullAnalogLevel / 2);
    EXPECT_EQ(bench.at(kStart + Ticks{1000}).analog[1], kFullAnalogLevel);
    EXPECT_EQ(bench.at(kMuchLater).analog, (AnalogLevels{kFullAnalogLevel, kFullAnalogLevel}));
}

TEST(Outputs, ThatAreAnalogAreReportedInTheirOwnBits) {
    RegisterWindow window = RegisterWindow::in_process();
    const AnalogLevels levels{1, 2, 3, kFullAnalogLevel, 5, 6, 7, kFullAnalogLevel};
    store_analog(window, levels);
    EXPECT_EQ(load_analog(window), levels);
    EXPECT_EQ(window.load(registers::kAnalogLower), 0x8000'0003'0002'0001U);
    EXPECT_EQ(window.load(registers::kAnalogUpper), 0x8000'0007'0006'0005U);
}

TEST(Outputs, AFrameThatIsRunLeavesOutTheTailsOfThoseBefore) {
    OutputBench bench;
    bench.load(frame(1), {{}, {at(1, kValve, kValve)}});
    bench.load(last_frame(2), {});
    bench.order(device::Arm{2});
    (void)bench.at(kMuchLater);
    EXPECT_TRUE(bench.events().empty());
}

TEST(Outputs, AnAnalogValueChangesByItsSlopeWithEachTick) {
    OutputBench bench;
    const std::int64_t slope = kFullScale / 1000;
    bench.load(last_frame(1),
               {{ramp(100, 0, slope), ramp(600, kFullScale / 2, 0), ramp(1000, kFullScale / 2, -slope)}, {}});
    bench.order(device::Arm{1});
    const auto value = [&](std::int64_t ticks) {
        (void)bench.at(kStart + Ticks{ticks});
        return bench.device.outputs().analog(0, bench.device.now());
    };
    EXPECT_EQ(value(100), 0);
    EXPECT_EQ(value(101), slope);
    EXPECT_EQ(value(350), 250 * slope);
    EXPECT_EQ(value(700), kFullScale / 2);
    EXPECT_EQ(value(1200), kFullScale / 2 - 200 * slope);
    EXPECT_EQ(value(5000), kFullScale / 2 - 280 * slope) << "the run has ended at 1280, and with it the slope";
    const std::vector<ChannelEvent> expected{
        analog(kStart + Ticks{100}, 0, slope), analog(kStart + Ticks{600}, kFullScale / 2, 0),
        analog(kStart + Ticks{1000}, kFullScale / 2, -slope), analog(kStart + kBody, kFullScale / 2 - 280 * slope, 0)};
    EXPECT_EQ(bench.events(), expected);
}

TEST(Outputs, AnAnalogOutputShowsNothingBelowZeroOrAboveFullScale) {
    OutputBench bench;
    bench.load(last_frame(1), {{ramp(1, kFullScale / 2, kFullScale / 100), ramp(500, 1000, -kFullScale / 100)}, {}});
    bench.order(device::Arm{1});
    (void)bench.at(kStart + Ticks{120});
    EXPECT_EQ(bench.device.outputs().analog(0, bench.device.now()), kFullScale);
    (void)bench.at(kStart + Ticks{600});
    EXPECT_EQ(bench.device.outputs().analog(0, bench.device.now()), 0);
}

/// An accumulator without a bound would wrap to full scale after some hundred ticks.
TEST(Outputs, AnAnalogValueStaysAtZeroHoweverLongItsSlopeGoesOn) {
    OutputBench bench;
    device::LoadFrame dwell{1, kStart, true, {Position::steps(0), {{Ticks{1'000'000'000}, {}, {}}}, {}}};
    bench.load(dwell, {{ramp(1, kFullScale, -kFullScale / 300)}, {}});
    bench.order(device::Arm{1});
    for (const std::int64_t ticks : {400, 700, 1000, 1'000'000, 999'999'999}) {
        (void)bench.at(kStart + Ticks{ticks});
        EXPECT_EQ(bench.device.outputs().analog(0, bench.device.now()), 0) << ticks;
    }
}

TEST(Outputs, MalformedChangesOfAFrameLeaveAllItsOutputsAlone) {
    const OutputTrack malformed[] = {{{at(1, kLaser, kLaser), at(0, 0, kLaser)}, {}},
                                     {{at(700, kLaser, kLaser), at(600, 0, kLaser)}, {}},
                                     {{at(1, 0x100, 0x100)}, {}},
                                     {{{Ticks{1}, RampAnalog{.channel = 2, .value = 1}}}, {}}};
    for (const OutputTrack& track : malformed) {
        OutputBench bench;
        bench.load(frame(1), track);
        bench.load(last_frame(2), {{at(5, kValve, kValve)}, {}});
        bench.order(device::Arm{2});
        const DeviceStatus after = bench.at(kMuchLater);
        EXPECT_TRUE(after.bad_output);
        EXPECT_EQ(after.position.count(), 20) << "the motion goes on";
        EXPECT_EQ(bench.events(), std::vector{digital(kStart + kBody + Ticks{5}, kValve, 10)});
    }
}

TEST(Outputs, ThatDoNotFitIntoTheRingAreRefusedWithNothingWritten) {
    DeviceBench bench(endless_axis(), {.output_entries = 16});
    bench.order(device::BeginRun{1});
    OutputTrack track;
    for (int k = 1; k <= 17; ++k) { track.body.append(at(k, kLaser, kLaser)); }
    const auto refused = bench.driver.apply(device::LoadOutputs{1, track});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error(),
              "device: the outputs of frame 1 are not loaded: they change 17 times, but the ring has room for 16");
    EXPECT_EQ(bench.window.load(registers::kOutputHead), 0u);
}

TEST(Outputs, OfARunThatIsReplacedAreDropped) {
    OutputBench bench;
    bench.load(frame(1), {{at(1, kLaser, kLaser)}, {}});
    bench.order(device::BeginRun{2});
    bench.load(last_frame(1), {{at(2, kValve, kValve)}, {}});
    bench.order(device::Arm{1});
    (void)bench.at(kMuchLater);
    EXPECT_EQ(bench.events(), std::vector{digital(kStart + Ticks{2}, kValve, 0)});
}

TEST(Outputs, ChangeAtOnceByADirectOrder) {
    OutputBench bench;
    (void)bench.at(Tick{50});
    bench.order(device::ChangeOutputs{{kLaser | kValve, kLaser | kValve}, {{.channel = 1, .value = 7}}});
    EXPECT_EQ(bench.at(Tick{60}).outputs, kLaser | kValve);
    EXPECT_EQ(bench.device.outputs().analog(1, Tick{60}), 7);
    bench.order(device::ChangeOutputs{{0, kLaser}, {}});
    EXPECT_EQ(bench.at(Tick{70}).outputs, kValve);
    EXPECT_EQ(bench.device.outputs().analog(1, Tick{70}), 7);
}

DeviceSetup safe_setup() {
    return {.at_cut = {.digital = {.levels = 0, .mask = kLaser}, .analog_off = 1},
            .at_silence = {.digital = {.levels = kValve, .mask = kLaser | kValve}, .analog_off = 1},
            .silence = Ticks{5000}};
}

TEST(Outputs, FallAsConfiguredWhenARunIsCutAndStayWhenItEndsByItsLastFrame) {
    for (const bool is_cut : {true, false}) {
        OutputBench bench(safe_setup());
        bench.load(is_cut ? frame(1) : last_frame(1),
                   {{at(1, kLaser | kValve, kLaser | kValve), ramp(1, kFullScale, 0)}, {}});
        bench.order(device::Arm{1});
        const DeviceStatus after = bench.at(Tick{4000});
        EXPECT_TRUE(after.finished);
        EXPECT_EQ(after.outputs, is_cut ? kValve : kLaser | kValve);
        EXPECT_EQ(bench.device.outputs().analog(0, bench.device.now()), is_cut ? 0 : kFullScale);
    }
}

TEST(Outputs, FallAtTheTickOfAStopOrALimit) {
    OutputBench bench(safe_setup());
    bench.load(frame(1), {{at(1, kLaser, kLaser)}, {}});
    bench.order(device::Arm{1});
    (void)bench.at(kStart + Ticks{300});
    bench.order(device::StopNow{});
    (void)bench.at(kStart + Ticks{400});
    EXPECT_EQ(bench.events().back(), digital(kStart + Ticks{300}, 0, 2));
}

/// The bench's driver beats when it is read.
TEST(Outputs, FallWhenTheHostIsSilentAndStayUntilItBeatsAgain) {
    OutputBench bench(safe_setup());
    (void)bench.at(Tick{100});
    bench.order(device::ChangeOutputs{{kLaser, kLaser}, {{.channel = 0, .value = kFullScale}}});
    (void)bench.at(Tick{4000});
    (void)bench.at(Tick{8000});
    bench.device.advance(Tick{20'000});
    EXPECT_EQ(bench.window.load(registers::kOutputs), kValve);
    bench.order(device::ChangeOutputs{{kLaser, kLaser}, {}});
    bench.device.advance(Tick{20'001});
    EXPECT_EQ(bench.window.load(registers::kOutputs), kValve) << "a silent host changes nothing";
    const DeviceStatus silent = bench.driver.read().value();
    EXPECT_TRUE(silent.host_silent);
    const std::vector<ChannelEvent> events = bench.events();
    EXPECT_EQ(events[events.size() - 2], digital(Tick{13'000}, kValve, 0)) << "5000 ticks after the last beat it saw";
    EXPECT_EQ(events.back(), analog(Tick{13'000}, 0, 0));
    EXPECT_FALSE(bench.at(Tick{20'100}).host_silent);
    bench.order(device::ChangeOutputs{{kLaser, kLaser}, {}});
    EXPECT_EQ(bench.at(Tick{20'200}).outputs, kLaser | kValve);
}

TEST(Outputs, OfFramesThatASilentHostHadArmedDoNotChangeButTheMotionGoesOn) {
    DeviceSetup setup = safe_setup();
    setup.silence = Ticks{1500};
    OutputBench bench(setup);
    bench.load(frame(1), {{at(1, kLaser, kLaser)}, {}});
    bench.load(last_frame(2), {{at(1, kLaser, kLaser)}, {}});
    bench.order(device::Arm{2});
    bench.device.advance(kMuchLater);
    EXPECT_EQ(bench.window.load(registers::kOutputs), kValve);
    EXPECT_EQ(bench.driver.read()->position.count(), 20);
}

TEST(Outputs, AMotorIsDisabledAtSilenceIfTheSetupSaysSo) {
    DeviceSetup setup = safe_setup();
    setup.disable_at_silence = true;
    OutputBench bench(setup);
    EXPECT_TRUE(bench.at(Tick{100}).enabled);
    bench.device.advance(Tick{20'000});
    EXPECT_EQ(bench.window.load(registers::kStatus) & registers::kStatusEnabled, 0u);
}

TEST(Compare, EachStepAtAPlaceMakesAPulseOnTheStepItself) {
    DeviceSetup setup;
    setup.compare_outputs = kLaser;
    setup.compare_pulse = Ticks{10};
    OutputBench bench(setup);
    bench.load(last_frame(1), {{{Ticks{1}, ComparePosition{.next = 3, .every = 2, .pulses = 3}}}, {}});
    bench.order(device::Arm{1});
    std::vector<std::int64_t> on;
    std::uint16_t before = 0;
    for (Tick now = kStart; now < kStart + kBody; now += Ticks{1}) {
        const std::uint16_t outputs = bench.at(now).outputs;
        if (outputs != before) { on.push_back((now - kStart).value); }
        before = outputs;
    }
    const std::vector<StepEdge> steps = bench.steps();
    std::vector<std::int64_t> expected;
    for (const std::size_t step : {2u, 4u, 6u}) {
        const std::int64_t tick = (steps[step].tick - kStart).value;
        expected.insert(expected.end(), {tick, tick + 10});
    }
    EXPECT_EQ(on, expected);
    const std::vector<ChannelEvent> events = bench.events();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[0].kind, Kind::CompareBegins);
    EXPECT_EQ(events[1].kind, Kind::CompareEnds);
    EXPECT_EQ(events[1].tick, steps[6].tick);
    EXPECT_EQ(events[1].value, 7);
    EXPECT_EQ(events[1].detail, 0);
}

TEST(Compare, GoesBackwardAndSaysHowManyPulsesWereNotMade) {
    DeviceSetup setup;
    setup.compare_outputs = kValve;
    OutputBench bench(setup);
    bench.load(
        [] {
            device::LoadFrame back = frame(1, -1);
            back.last = true;
            back.track.tail.clear();
            return back;
        }(),
        {{{Ticks{1}, ComparePosition{.next = -4, .every = -4, .pulses = 5}}}, {}});
    bench.order(device::Arm{1});
    (void)bench.at(kMuchLater);
    const std::vector<ChannelEvent> events = bench.events();
    ASSERT_EQ(events.size(), 2u);
    EXPECT_EQ(events[1].detail, 3) << "places -4 and -8 of a way to -10";
}

}  // namespace
}  // namespace lockstep
