// The firmware in an emulator of the RP2040: one board, three motors, each edge of a pin where core/step puts it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

#include "core/step/tick_engine.hpp"
#include "services/axis/device_driver.hpp"
#include "sim_fpga/firmware/host/host_words.hpp"
#include "tests/simulation/board/emulated_board.hpp"

namespace lockstep::testing {
namespace {

constexpr std::size_t kMotors = 3;
constexpr std::int64_t kTick_ns = 1000;
constexpr double kCyclesPerTick = 125;
constexpr double kDirectionToStep = 75;  // 600 ns

constexpr int kLeastStep = 16;  // in ticks, from one step to the next

/// The times that a motor's pins must keep, in ticks.
struct PinTimes {
    int pulse = 1;
    int delay = kLeastStep;  // from its tick to the pulse
    int setup = 0;           // from a change of direction to the pulse, and 600 ns more
};

unsigned step_pin(std::size_t motor) { return static_cast<unsigned>(2 + motor); }
unsigned direction_pin(std::size_t motor) { return static_cast<unsigned>(6 + motor); }

/// What the pins of a motor did, in ticks since the machines began.
class PinWatch {
public:
    void take(const PinEdge& edge, std::size_t motor, double start) {
        if (edge.pin == direction_pin(motor)) { turn(edge); }
        if (edge.pin != step_pin(motor)) { return; }
        if (!edge.is_high) {
            EXPECT_EQ(edge.cycle - rose_, times.pulse * kCyclesPerTick);
            return;
        }
        const double before = std::exchange(rose_, edge.cycle);
        const double ticks = (edge.cycle - start - kDirectionToStep) / kCyclesPerTick - times.delay;
        EXPECT_EQ(std::fmod(edge.cycle - start, kCyclesPerTick), kDirectionToStep) << "behind the tick";
        EXPECT_GE(edge.cycle - turned_, kDirectionToStep + times.setup * kCyclesPerTick);
        EXPECT_GE(edge.cycle - before, kLeastStep * kCyclesPerTick);
        steps.push_back({Tick{1 + static_cast<std::int64_t>(ticks)}, static_cast<std::int8_t>(is_forward_ ? 1 : -1)});
    }

    PinTimes times;
    std::vector<StepEdge> steps;

private:
    void turn(const PinEdge& edge) {
        EXPECT_GE(edge.cycle - rose_, times.pulse * kCyclesPerTick) << "a direction changes in a pulse";
        is_forward_ = edge.is_high;
        turned_ = edge.cycle;
    }

    bool is_forward_ = false;
    double rose_ = -100 * kCyclesPerTick;
    double turned_ = -100 * kCyclesPerTick;
};

/// The board, and a host at the other end of its line.
class BoardBench {
public:
    static constexpr std::uint32_t kSlice_us = 500;

    void run(std::uint32_t until_us) {
        constexpr std::size_t kBytesPerSlice = 50;
        while (now_us_ < until_us) {
            firmware::Frame frame;
            while (waiting_.size() < kBytesPerSlice && link_.next_frame(now_us_, frame)) {
                waiting_.insert(waiting_.end(), frame.bytes, frame.bytes + frame.size);
            }
            const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(std::min(kBytesPerSlice, waiting_.size()));
            std::vector<std::uint8_t> bytes(waiting_.begin(), end);
            spoil(bytes);
            waiting_.erase(waiting_.begin(), end);
            now_us_ += kSlice_us;
            take(board_.run(now_us_, levels_, bytes));
        }
    }
    /// From now on one byte of a thousand comes damaged, either way.
    void damage() { is_poor_ = true; }
    /// The upper limit switch of a motor.
    void close_switch(std::size_t motor) { levels_ |= 1U << (14 + 3 * motor); }
    DeviceDriver driver(std::size_t motor) { return DeviceDriver::attach(windows_[motor], kTick_ns).value(); }
    bool is_connected() const { return windows_[kMotors - 1].load(registers::kMagic) == registers::kMagicValue; }
    std::uint32_t now_us() const { return now_us_; }
    const std::vector<StepEdge>& steps(std::size_t motor) const { return pins_[motor].steps; }
    void expect(std::size_t motor, const PinTimes& times) { pins_[motor].times = times; }
    /// The share of the busiest 2.5 ms so far in which the processor was in interrupts: it executed ticks.
    double busiest() const { return busiest_; }

private:
    void spoil(std::vector<std::uint8_t>& bytes) {
        for (std::uint8_t& byte : bytes) {
            if (is_poor_ && random_() % 1000 == 0) { byte = static_cast<std::uint8_t>(byte ^ (1U << random_() % 8)); }
        }
    }
    void take(EmulatedBoard::Answer answer) {
        measure(answer.interrupted);
        spoil(answer.sent);
        for (const std::uint8_t byte : answer.sent) { link_.take(byte, now_us_); }
        for (const PinEdge& edge : answer.edges) {
            if (edge.pin == kStartPin) { start_ = edge.cycle; }
            for (std::size_t motor = 0; motor < kMotors; ++motor) { pins_[motor].take(edge, motor, start_); }
        }
    }

    void measure(std::uint32_t cycles) {
        constexpr std::size_t kSlices = 5;
        interrupted_.push_back(cycles);
        if (interrupted_.size() > kSlices) { interrupted_.pop_front(); }
        const double sum = std::accumulate(interrupted_.begin(), interrupted_.end(), 0.0);
        busiest_ = std::max(busiest_, sum / (kSlices * kSlice_us * kCyclesPerTick));
    }

    EmulatedBoard board_{LOCKSTEP_BOARD_EMULATOR, LOCKSTEP_BOARD_FIRMWARE};
    std::vector<RegisterWindow> windows_{RegisterWindow::in_process(), RegisterWindow::in_process(),
                                         RegisterWindow::in_process()};
    firmware::HostWords words_{windows_};
    firmware::Link link_{words_, 1};
    std::array<PinWatch, kMotors> pins_;
    std::deque<std::uint8_t> waiting_;
    std::uint32_t now_us_ = 0;
    double start_ = 0;
    std::uint32_t levels_ = 0;               // of the input pins; pin n is bit n
    std::deque<std::uint32_t> interrupted_;  // of the last slices
    double busiest_ = 0;
    bool is_poor_ = false;
    std::mt19937_64 random_{1};
};

struct Course {
    std::vector<device::LoadFrame> frames;
    FrameNumber armed;
    std::vector<StepEdge> steps;  // of the armed frames, and of a tail behind them
    Tick end;
};

/// At most a step per 16 ticks, either way.
std::int64_t any_speed(std::mt19937_64& random) {
    const auto speed = static_cast<std::int64_t>(random() / 16);
    return random() % 4 == 0 ? -speed : speed;
}

Piece any_piece(std::mt19937_64& random, std::int64_t most_ticks) {
    const std::int64_t speed = any_speed(random);
    const Ticks ticks{128 + static_cast<std::int64_t>(random() % 10'000) % most_ticks};
    return {ticks, {speed}, {(any_speed(random) - speed) / ticks.value}};
}

/// The steps of pieces from a tick and a place on, which move to their end.
template <typename Pieces>
void append_steps(const Pieces& pieces, Tick& tick, Position& at, std::vector<StepEdge>& steps) {
    for (const Piece& piece : pieces) {
        tick_by_tick({tick, at, piece}, [&](StepEdge step) { steps.push_back(step); });
        tick += piece.ticks;
        at = at + piece.covered();
    }
}

constexpr FrameNumber kFrames = 4;

/// Frames of any pieces, one of which has many.
Course course(std::uint64_t seed, Tick start, FrameNumber armed) {
    std::mt19937_64 random(seed);
    Course result{{}, armed, {}, start};
    Position at = rest_position(0, false);
    std::vector<StepEdge> not_armed;
    for (FrameNumber number = 1; number <= kFrames; ++number) {
        device::LoadFrame frame{number, start, number == kFrames, {at, {}, {}}};
        const std::int64_t pieces = number == 2 ? 40 : 5;
        for (std::int64_t left = pieces; left > 0; --left) {
            frame.track.body.append(any_piece(random, 10'000 / pieces));
        }
        append_steps(frame.track.body, start, at, number <= armed ? result.steps : not_armed);
        if (!frame.last) { frame.track.tail.append(any_piece(random, 2000)); }
        if (number == armed) {
            result.end = start;
            Position rest = at;
            append_steps(frame.track.tail, result.end, rest, result.steps);
        }
        result.frames.push_back(frame);
    }
    return result;
}

/// To and fro at a step per 20 ticks, for 80 pieces.
Course turns(std::uint64_t seed, Tick start) {
    std::mt19937_64 random(seed);
    Course result{{}, kFrames, {}, start};
    Position at = rest_position(0, false);
    std::int64_t speed = std::numeric_limits<std::int64_t>::max() / 10;
    for (FrameNumber number = 1; number <= kFrames; ++number) {
        device::LoadFrame frame{number, result.end, number == kFrames, {at, {}, {}}};
        for (int left = 20; left > 0; --left) {
            frame.track.body.append({Ticks{300 + static_cast<std::int64_t>(random() % 250)}, {speed}, {}});
            speed = -speed;
        }
        append_steps(frame.track.body, result.end, at, result.steps);
        result.frames.push_back(frame);
    }
    return result;
}

/// Forward, at a step per 20 ticks.
Course long_way(Tick start, Ticks ticks) {
    const Piece piece{ticks, {std::numeric_limits<std::int64_t>::max() / 10}, {}};
    Course result{{{1, start, true, {rest_position(0, false), {piece}, {}}}}, 1, {}, start};
    Position at = rest_position(0, false);
    append_steps(result.frames.front().track.body, result.end, at, result.steps);
    return result;
}

/// Without each step that the opposite one follows before the pins could turn: neither comes to the pins.
std::vector<StepEdge> without_short_turns(const std::vector<StepEdge>& steps) {
    std::vector<StepEdge> edges;
    bool is_open = false;  // the last edge may be taken back
    for (const StepEdge& step : steps) {
        const bool turns = is_open && step.direction != edges.back().direction;
        if (turns && step.tick - edges.back().tick < Ticks{kLeastStep}) {
            edges.pop_back();
            is_open = false;
        } else {
            edges.push_back(step);
            is_open = true;
        }
    }
    return edges;
}

class Board : public ::testing::Test {
protected:
    void SetUp() override {
        while (!bench.is_connected()) {
            ASSERT_LT(bench.now_us(), 200'000U) << "the board does not answer";
            bench.run(bench.now_us() + 1000);
        }
        for (std::size_t motor = 0; motor < kMotors; ++motor) { drivers.push_back(bench.driver(motor)); }
    }
    /// For the line to bring all frames to the board.
    Tick soon() const { return Tick{static_cast<std::int64_t>(bench.now_us()) + 120'000}; }

    void order(std::size_t motor, const Course& course, const DeviceSetup& setup = {}) {
        ASSERT_TRUE(drivers[motor].set_up(setup));
        ASSERT_TRUE(drivers[motor].apply(device::BeginRun{1}));
        for (const auto& frame : course.frames) { ASSERT_TRUE(drivers[motor].apply(frame)); }
        ASSERT_TRUE(drivers[motor].apply(device::Arm{course.armed}));
    }
    void run(std::int64_t until_us) {
        while (bench.now_us() < until_us) {
            bench.run(bench.now_us() + 1000);
            for (std::size_t motor = 0; motor < kMotors; ++motor) {
                ASSERT_TRUE(drivers[motor].drain_capture([&](StepEdge step) { recorded[motor].push_back(step); }));
            }
        }
    }
    /// Until the line has brought the news that the motor's run has ended, which come behind the ticks of all steps.
    void run_to_end(std::size_t motor) {
        for (int left = 200; left > 0; --left) {
            const auto status = drivers[motor].read();
            if (status && status->run == 1 && status->finished) { return; }
            run(bench.now_us() + 10'000);
        }
        ADD_FAILURE() << "motor " << motor << " does not end its run";
    }
    void expect_steps(const Course& course, std::size_t motor) {
        const std::vector<StepEdge> edges = without_short_turns(course.steps);
        EXPECT_TRUE(bench.steps(motor) == edges)
            << "motor " << motor << ": " << bench.steps(motor).size() << " edges, not " << edges.size();
        EXPECT_TRUE(recorded[motor] == course.steps) << recorded[motor].size() << " recorded";
        const auto status = drivers[motor].read();
        ASSERT_TRUE(status);
        EXPECT_TRUE(status->finished && !status->bad_segment && !status->capture_overflow);
        EXPECT_EQ(status->in_tail, course.armed < course.frames.size());
    }

    BoardBench bench;
    std::vector<DeviceDriver> drivers;
    std::array<std::vector<StepEdge>, kMotors> recorded;
};

TEST_F(Board, MakesEachPinEdgeOfItsFrames) {
    const Tick start = soon();
    const std::array courses{course(1, start, kFrames), course(2, start, kFrames), course(3, start, kFrames)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
    EXPECT_LE(bench.busiest(), 0.91) << "sim_fpga/firmware/README.md states it";
}

/// Each motor has a driver of its own kind. The times are the longest, some in between, and some below a tick.
TEST_F(Board, KeepsThePulseTimesOfEachDriver) {
    const Tick start = soon();
    const std::array courses{course(6, start, kFrames), course(7, start, kFrames), course(8, start, kFrames)};
    const std::array<DeviceSetup, kMotors> setups{
        {{.step_width_ns = 7000, .direction_setup_ns = 7000, .direction_hold_ns = 7000},
         {.step_width_ns = 2500, .direction_setup_ns = 5000, .direction_hold_ns = 5000},
         {.step_width_ns = 500, .direction_setup_ns = 600}}};
    constexpr std::array<PinTimes, kMotors> kTimes{
        {{.pulse = 7, .delay = 23, .setup = 7}, {.pulse = 3, .delay = 21, .setup = 5}, {}}};
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        bench.expect(motor, kTimes[motor]);
        order(motor, courses[motor], setups[motor]);
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
}

TEST_F(Board, LeavesOutAStepAndItsOppositeThatPinsCannotFollow) {
    const Tick start = soon();
    const std::array courses{turns(1, start), turns(2, start), turns(3, start)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        bench.expect(motor, {.pulse = 7, .delay = 23, .setup = 7});
        order(motor, courses[motor], {.step_width_ns = 7000, .direction_setup_ns = 7000, .direction_hold_ns = 7000});
        EXPECT_GT(courses[motor].steps.size() - without_short_turns(courses[motor].steps).size(), 40U);
    }
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { expect_steps(courses[motor], motor); }
}

TEST_F(Board, RefusesPulseTimesThatItCannotKeep) {
    EXPECT_FALSE(drivers[0].set_up({.step_width_ns = 7001}));
    EXPECT_FALSE(drivers[0].set_up({.direction_hold_ns = 8000}));
    EXPECT_TRUE(drivers[0].set_up({.direction_setup_ns = 7000}));
}

/// Motor 0 may run two frames. The switch of motor 1 closes on its way. Motor 2 is not concerned, and a byte of a
/// thousand is damaged.
TEST_F(Board, EndsInATailOrAtASwitchAndCountsWhatItMade) {
    constexpr Ticks kWay{60'000};
    constexpr std::int64_t kDelay = 1168;  // from a switch to the pins
    bench.damage();
    const Tick start = soon() + Ticks{200'000};
    const std::array courses{course(4, start, 2), long_way(start, kWay), course(5, start, kFrames)};
    for (std::size_t motor = 0; motor < kMotors; ++motor) { order(motor, courses[motor]); }
    const Tick closed = start + Ticks{20'000};
    run(closed.value);
    bench.close_switch(1);
    for (std::size_t motor = 0; motor < kMotors; ++motor) { run_to_end(motor); }
    run(bench.now_us() + 1000);
    expect_steps(courses[0], 0);
    expect_steps(courses[2], 2);
    const auto status = drivers[1].read();
    ASSERT_TRUE(status);
    EXPECT_TRUE(status->stopped_by_limit);
    ASSERT_FALSE(bench.steps(1).empty());
    EXPECT_EQ(status->position.count(), static_cast<std::int64_t>(bench.steps(1).size()));
    EXPECT_LE(bench.steps(1).back().tick, closed + Ticks{kDelay + 5000})
        << "the board's first tick is 5 ms behind power-up";
    EXPECT_GE(bench.steps(1).back().tick, closed - Ticks{5000});
}

}  // namespace
}  // namespace lockstep::testing
