// The firmware in an emulator of the RP2040: one board, three motors, each edge of a pin where core/step puts it.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <random>
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
constexpr double kPulse = 50;            // 400 ns

unsigned step_pin(std::size_t motor) { return static_cast<unsigned>(2 + motor); }
unsigned direction_pin(std::size_t motor) { return static_cast<unsigned>(6 + motor); }

/// What the pins of a motor did, in ticks since the machines began.
class PinWatch {
public:
    void take(const PinEdge& edge, std::size_t motor, double start) {
        if (edge.pin == direction_pin(motor)) { turn(edge); }
        if (edge.pin != step_pin(motor)) { return; }
        if (!edge.is_high) {
            EXPECT_EQ(edge.cycle - rose_, kPulse);
            return;
        }
        rose_ = edge.cycle;
        const double ticks = (edge.cycle - start - kDirectionToStep) / kCyclesPerTick;
        EXPECT_EQ(std::fmod(edge.cycle - start, kCyclesPerTick), kDirectionToStep) << "behind the tick";
        EXPECT_GE(edge.cycle - turned_, kDirectionToStep);
        steps.push_back({Tick{1 + static_cast<std::int64_t>(ticks)}, static_cast<std::int8_t>(is_forward_ ? 1 : -1)});
    }

    std::vector<StepEdge> steps;

private:
    void turn(const PinEdge& edge) {
        EXPECT_GE(edge.cycle - rose_, kPulse);
        is_forward_ = edge.is_high;
        turned_ = edge.cycle;
    }

    bool is_forward_ = false;
    double rose_ = -kCyclesPerTick;
    double turned_ = -kCyclesPerTick;
};

/// The board, and a host at the other end of its line.
class BoardBench {
public:
    void run(std::uint32_t until_us) {
        constexpr std::uint32_t kSlice_us = 500;
        constexpr std::size_t kBytesPerSlice = 50;
        while (now_us_ < until_us) {
            firmware::Frame frame;
            while (waiting_.size() < kBytesPerSlice && link_.next_frame(now_us_, frame)) {
                waiting_.insert(waiting_.end(), frame.bytes, frame.bytes + frame.size);
            }
            const auto end = waiting_.begin() + static_cast<std::ptrdiff_t>(std::min(kBytesPerSlice, waiting_.size()));
            const std::vector<std::uint8_t> bytes(waiting_.begin(), end);
            waiting_.erase(waiting_.begin(), end);
            now_us_ += kSlice_us;
            take(board_.run(now_us_, bytes));
        }
    }
    DeviceDriver driver(std::size_t motor) { return DeviceDriver::attach(windows_[motor], kTick_ns).value(); }
    bool is_connected() const { return windows_[kMotors - 1].load(registers::kMagic) == registers::kMagicValue; }
    std::uint32_t now_us() const { return now_us_; }
    const std::vector<StepEdge>& steps(std::size_t motor) const { return pins_[motor].steps; }

private:
    void take(const EmulatedBoard::Answer& answer) {
        for (const std::uint8_t byte : answer.sent) { link_.take(byte, now_us_); }
        for (const PinEdge& edge : answer.edges) {
            if (edge.pin == kStartPin) { start_ = edge.cycle; }
            for (std::size_t motor = 0; motor < kMotors; ++motor) { pins_[motor].take(edge, motor, start_); }
        }
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
};

struct Course {
    std::vector<device::LoadFrame> frames;
    std::vector<StepEdge> steps;
    Tick end;
};

/// At most a step per 16 ticks, either way.
std::int64_t any_speed(std::mt19937_64& random) {
    const auto speed = static_cast<std::int64_t>(random() / 16);
    return random() % 4 == 0 ? -speed : speed;
}

/// Frames of any pieces, one of which has many.
Course course(std::uint64_t seed, Tick start) {
    constexpr FrameNumber kFrames = 4;
    std::mt19937_64 random(seed);
    Course result;
    Position at = rest_position(0, false);
    for (FrameNumber number = 1; number <= kFrames; ++number) {
        device::LoadFrame frame{number, start, number == kFrames, {at, {}, {}}};
        const std::int64_t pieces = number == 2 ? 40 : 5;
        for (std::int64_t left = pieces; left > 0; --left) {
            const std::int64_t speed = any_speed(random);
            const Ticks ticks{128 + static_cast<std::int64_t>(random() % 10'000) / pieces};
            const Piece piece{ticks, {speed}, {(any_speed(random) - speed) / ticks.value}};
            tick_by_tick({start, at, piece}, [&](StepEdge step) { result.steps.push_back(step); });
            (void)frame.track.body.push_back(piece);
            start += ticks;
            at = at + piece.covered();
        }
        result.frames.push_back(frame);
    }
    result.end = start;
    return result;
}

TEST(Board, MakesEachPinEdgeOfItsFrames) {
    BoardBench bench;
    while (!bench.is_connected()) {
        ASSERT_LT(bench.now_us(), 100'000U) << "the board does not answer";
        bench.run(bench.now_us() + 1000);
    }
    const Tick start{static_cast<std::int64_t>(bench.now_us()) + 120'000};
    std::vector<DeviceDriver> drivers;
    std::vector<Course> courses;
    std::vector<std::vector<StepEdge>> recorded(kMotors);
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        drivers.push_back(bench.driver(motor));
        courses.push_back(course(motor + 1, start));
        ASSERT_TRUE(drivers[motor].set_up({}));
        ASSERT_TRUE(drivers[motor].apply(device::BeginRun{1}));
        for (const auto& frame : courses[motor].frames) { ASSERT_TRUE(drivers[motor].apply(frame)); }
        ASSERT_TRUE(drivers[motor].apply(device::Arm{courses[motor].frames.size()}));
    }
    Tick end;
    for (const Course& course : courses) { end = std::max(end, course.end); }
    constexpr std::uint32_t kRecords_us = 400'000;  // for the line to bring the ticks of all steps
    const auto are_all_recorded = [&] {
        return std::ranges::equal(recorded, courses, {}, &std::vector<StepEdge>::size,
                                  [](const Course& one) { return one.steps.size(); });
    };
    while (bench.now_us() < end.value + kRecords_us && (bench.now_us() < end.value + 5000 || !are_all_recorded())) {
        bench.run(bench.now_us() + 1000);
        for (std::size_t motor = 0; motor < kMotors; ++motor) {
            ASSERT_TRUE(drivers[motor].drain_capture([&](StepEdge step) { recorded[motor].push_back(step); }));
        }
    }
    bench.run(bench.now_us() + 20'000);
    for (std::size_t motor = 0; motor < kMotors; ++motor) {
        const auto status = drivers[motor].read();
        ASSERT_TRUE(status);
        EXPECT_TRUE(status->finished && !status->bad_segment && !status->in_tail && !status->capture_overflow);
        EXPECT_TRUE(bench.steps(motor) == courses[motor].steps)
            << "motor " << motor << ": " << bench.steps(motor).size() << " edges, not " << courses[motor].steps.size();
        EXPECT_TRUE(recorded[motor] == courses[motor].steps) << recorded[motor].size() << " recorded";
    }
}

}  // namespace
}  // namespace lockstep::testing
