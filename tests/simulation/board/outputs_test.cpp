// The board's digital outputs in the emulator: each edge of a pin in its tick, and safe levels when something fails.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <random>
#include <vector>

#include "tests/simulation/board/board_fixture.hpp"

namespace lockstep::testing {
namespace {

constexpr Ticks kBody{4000};
constexpr Ticks kTail{1000};
constexpr FrameNumber kThree = 3;
constexpr FrameNumber kArmed = 2;

/// The pins of a motor's outputs.
const std::array<std::vector<std::uint8_t>, kMotors> kPins{{{22, 26}, {27}, {28}}};

using Changes = std::map<std::uint8_t, std::vector<LevelChange>>;  // by pin

/// Slow frames, with outputs.
class OutputBoard : public Board {
protected:
    device::LoadFrame frame(FrameNumber number, Tick start, Position& from) const {
        const std::int64_t speed = std::numeric_limits<std::int64_t>::max() / 100;
        device::LoadFrame frame{number, start, number == kThree, {from, {{kBody, {speed}, {}}}, {}}};
        if (!frame.last) { frame.track.tail.append({kTail, {speed}, {}}); }
        from = from + frame.track.body.begin()->covered();
        return frame;
    }
    void load(std::size_t motor, Tick start, const std::array<OutputTrack, kThree>& outputs) {
        Position from = rest_position(0, false);
        ASSERT_TRUE(drivers[motor].apply(device::BeginRun{1}));
        for (FrameNumber number = 1; number <= kThree; ++number) {
            ASSERT_TRUE(drivers[motor].apply(frame(number, start, from)));
            ASSERT_TRUE(drivers[motor].apply(device::LoadOutputs{number, outputs[number - 1]}));
            start += kBody;
        }
        ASSERT_TRUE(drivers[motor].apply(device::Arm{kArmed}));
    }

    /// An output of any motor changes at each of these times after the start of a frame.
    void draw(std::array<std::array<OutputTrack, kThree>, kMotors>& outputs, FrameNumber number, bool is_tail,
              Tick start, Ticks length, std::int64_t least = 8, std::uint64_t more = 300) {
        for (Ticks at{1}; at < length; at += Ticks{least + static_cast<std::int64_t>(random() % more)}) {
            const std::size_t motor = random() % kMotors;
            const std::size_t output = random() % kPins[motor].size();
            bool& level = levels[kPins[motor][output]];
            level = !level;
            const auto bit = static_cast<std::uint16_t>(1U << output);
            OutputTrack& track = outputs[motor][number - 1];
            const OutputChange change{at, SetDigital{level ? bit : std::uint16_t{0}, bit}};
            is_tail ? track.tail.append(change) : track.body.append(change);
            expected[kPins[motor][output]].push_back({start + at, level});
        }
    }

    std::mt19937_64 random{1};
    std::map<std::uint8_t, bool> levels;
    Changes expected;
};

/// Two frames of three may run, and the tail of the second one. Behind it, all outputs of motor 0 fall.
TEST_F(OutputBoard, ChangesEachOutputInItsTick) {
    const Tick start = soon();
    std::array<std::array<OutputTrack, kThree>, kMotors> outputs;
    draw(outputs, 1, false, start, kBody);
    draw(outputs, 2, false, start + kBody, kBody);
    draw(outputs, 2, true, start + kBody + kBody, kTail);
    const Tick end = start + kBody + kBody + kTail;
    for (const std::uint8_t pin : kPins[0]) {
        if (levels[pin]) { expected[pin].push_back({end, false}); }
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        const std::uint16_t cut = motor == 0 ? 3 : 0;
        ASSERT_TRUE(drivers[motor].set_up({.at_cut = {.digital = {.levels = 0, .mask = cut}}}));
        load(motor, start, outputs[motor]);
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 5000);
    for (const auto& [pin, changes] : expected) {
        EXPECT_GT(changes.size(), 3U);
        EXPECT_TRUE(bench.levels(pin) == changes)
            << "pin " << int{pin} << ": " << bench.levels(pin).size() << " changes, not " << changes.size();
    }
}

/// An output changes every one or two ticks.
TEST_F(OutputBoard, ShowsTheLastOfChangesThatAreTooNear) {
    const Tick start = soon();
    std::array<std::array<OutputTrack, kThree>, kMotors> outputs;
    draw(outputs, 1, false, start, Ticks{16}, 1, 2);
    draw(outputs, 2, false, start + kBody, Ticks{16}, 1, 2);
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        ASSERT_TRUE(drivers[motor].set_up({}));
        load(motor, start, outputs[motor]);
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 5000);
    for (const auto& [pin, changes] : expected) {
        const std::vector<LevelChange>& shown = bench.levels(pin);
        ASSERT_FALSE(shown.empty() && changes.size() % 2 == 1);
        if (shown.empty()) { continue; }
        EXPECT_EQ(shown.back().is_high, changes.back().is_high) << "pin " << int{pin};
        for (std::size_t n = 1; n < shown.size(); ++n) { EXPECT_GE(shown[n].tick - shown[n - 1].tick, Ticks{8}); }
    }
}

/// The levels of an output that is on for `length` from each step on that arrives at a place: at the count
/// `place.next`, and then `place.every` steps further each time.
std::vector<LevelChange> pulses_at(const std::vector<StepEdge>& steps, ComparePosition place, Ticks length) {
    std::vector<LevelChange> changes;
    std::int64_t count = 0;
    for (const StepEdge& step : steps) {
        count += step.direction;
        if (place.pulses == 0 || count != place.next) { continue; }
        place.next += place.every;
        --place.pulses;
        changes.push_back({step.tick, true});
        changes.push_back({step.tick + length, false});
    }
    return changes;
}

/// One motor after the other, because changes of two outputs may be nearer than 8 ticks. Places are at least 32 ticks
/// apart, and the last ones are never reached.
TEST_F(OutputBoard, BeginsEachPulseInTheTickOfTheStepThatReachesItsPlace) {
    constexpr ComparePosition kPlaces{.next = 3, .every = 2, .pulses = 100'000};
    constexpr std::array kLengths{Ticks{8}, Ticks{12}, Ticks{24}};
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        const Course way = course(20 + motor, soon(), kFrames);
        const DeviceSetup setup{.compare_outputs = 1, .compare_pulse = kLengths[motor]};
        order(motor, way, setup);
        OutputTrack outputs;
        outputs.body.append({Ticks{1}, kPlaces});
        ASSERT_TRUE(drivers[motor].apply(device::LoadOutputs{1, outputs}));
        run_to_end(motor);
        run(bench.now_us() + 5000);
        expect_steps(way, motor);
        const std::vector<LevelChange> pulses = pulses_at(way.steps, kPlaces, kLengths[motor]);
        EXPECT_GT(pulses.size(), 60U);
        EXPECT_TRUE(bench.levels(kPins[motor][0]) == pulses)
            << "motor " << motor << ": " << bench.levels(kPins[motor][0]).size() << " changes, not " << pulses.size();
        const auto status = drivers[motor].read();
        ASSERT_TRUE(status);
        EXPECT_EQ(status->pulses_left, kPlaces.pulses - pulses.size() / 2);
    }
}

/// The output of motor 2 is on while its pin is low.
TEST_F(OutputBoard, BringsOutputsToSafeLevelsWhenTheHostIsSilent) {
    constexpr Ticks kSilence{20'000};
    DeviceSetup setup{.at_silence = {.digital = {.levels = 0, .mask = 1}}, .silence = kSilence};
    ASSERT_TRUE(drivers[0].set_up(setup));
    setup.outputs_inverted = 1;
    ASSERT_TRUE(drivers[2].set_up(setup));
    for (const std::size_t motor : {0, 2}) { ASSERT_TRUE(drivers[motor].apply(device::ChangeOutputs{{1, 1}, {}})); }
    run(bench.now_us() + 60'000);
    const auto& plain = bench.levels(22);
    const auto& inverted = bench.levels(28);
    ASSERT_EQ(plain.size(), 2U);
    EXPECT_TRUE(plain[0].is_high && !plain[1].is_high);
    EXPECT_NEAR(static_cast<double>((plain[1].tick - plain[0].tick).value), 20'000, 2000);
    ASSERT_EQ(inverted.size(), 3U) << "off, on, off";
    EXPECT_TRUE(inverted[0].is_high && !inverted[1].is_high && inverted[2].is_high);
}

}  // namespace
}  // namespace lockstep::testing
