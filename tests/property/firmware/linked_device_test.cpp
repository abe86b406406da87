// A driver that works on a board's windows moves its motors as if the devices were in the process's memory.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "core/step/tick_engine.hpp"
#include "services/axis/device_driver.hpp"
#include "sim_fpga/firmware/device/device.hpp"
#include "sim_fpga/firmware/host/host_words.hpp"
#include "sim_fpga/firmware/link/board_words.hpp"
#include "sim_fpga/firmware/link/identify_word.hpp"
#include "tests/property/firmware/poor_line.hpp"
#include "tests/property/firmware/twin_devices.hpp"

namespace lockstep::testing {
namespace {

constexpr std::size_t kMotors = 2;

MotorConfig long_motor() {
    MotorConfig motor;
    motor.name = "X";
    motor.steps_per_mm = 80;
    motor.position_min_mm = -1e6;
    motor.position_max_mm = 1e6;
    motor.homing.switch_position_mm = -1e6;
    motor.plant = {.max_torque_accel_mm_s2 = 1e9, .max_jump_mm_s = 1e7};
    return motor;
}

/// A host with a window for each motor, a board with the motors' devices, and a line between. A tick is a microsecond.
class LinkedBoard final : firmware::Exchange {
public:
    LinkedBoard(LineFaults faults, std::uint64_t seed) : there_(faults, seed), back_(faults, ~seed) {}

    void run(std::uint32_t until_us) {
        for (; now_us_ < until_us; now_us_ += 32) {
            there_.advance(host_, board_, now_us_);
            back_.advance(board_, host_, now_us_);
            for (firmware::Device& device : devices_) { device.execute(now_us_); }
        }
    }
    /// At the board, by itself.
    void receive(firmware::Message message) {
        firmware::Frame frame;
        encode(message, frame);
        for (std::size_t n = 0; n < frame.size; ++n) { board_.take(frame.bytes[n], now_us_); }
    }
    /// A word of the board.
    std::uint64_t load(std::size_t motor, std::size_t offset) const { return words_[motor]->load(offset); }
    bool is_found() const {
        return std::ranges::all_of(windows_,
                                   [](const RegisterWindow& one) { return one.load(registers::kMagic) != 0; });
    }
    /// Asks the board to let its light blink.
    void identify(std::size_t motor) {
        windows_[motor].store(firmware::kIdentifyWord, windows_[motor].load(firmware::kIdentifyWord) + 1);
    }
    /// The levels of the motor's outputs, each with the tick from which on they hold.
    const auto& changes(std::size_t motor) const { return ports_[motor].changes(); }
    std::uint32_t light_requests() const { return board_words_.light_requests(); }
    DeviceDriver driver(std::size_t motor) { return DeviceDriver::attach(windows_[motor], kTwinTick_ns).value(); }

private:
    void enter() override {}
    void leave() override {}
    void prepare_orders() override {
        for (firmware::Device& device : devices_) { device.prepare_orders(); }
    }
    void take_orders() override {
        for (firmware::Device& device : devices_) { device.take_orders(); }
    }
    std::uint32_t publish(std::size_t motor) override {
        devices_[motor].publish();
        return 0;
    }

    static constexpr firmware::Abilities kAbilities{
        .inputs = 3, .digital_outputs = 1, .has_encoder = true, .can_enable = true};

    std::array<PlantPort, kMotors> ports_{PlantPort(Plant(long_motor(), kTwinTick_ns)),
                                          PlantPort(Plant(long_motor(), kTwinTick_ns))};
    std::array<firmware::Device, kMotors> devices_{firmware::Device(ports_[0], kAbilities, 0),
                                                   firmware::Device(ports_[1], kAbilities, 0)};
    std::array<firmware::Words*, kMotors> words_{&devices_[0].words(), &devices_[1].words()};
    std::vector<RegisterWindow> windows_{RegisterWindow::in_process(), RegisterWindow::in_process()};
    firmware::BoardWords board_words_{words_.data(), kMotors, *this};
    firmware::HostWords host_words_{windows_};
    firmware::Link board_{board_words_, 2};
    firmware::Link host_{host_words_, 1};
    PoorLine there_;
    PoorLine back_;
    std::uint32_t now_us_ = 0;
};

/// Frames there and back, and the steps of them.
struct Course {
    std::vector<device::LoadFrame> frames;
    std::vector<StepEdge> steps;
};

Course course(std::uint64_t seed, Tick start) {
    std::mt19937_64 random(seed);
    Course result;
    Position at = rest_position(0, false);
    for (FrameNumber number = 1; number <= 8; ++number) {
        device::LoadFrame frame{number, start, number == 8, {at, {}, {}}};
        for (int pieces = 0; pieces < 6; ++pieces) {
            const auto speed = static_cast<std::int64_t>(random() >> 8) * (number <= 4 ? 1 : -1);
            const Piece piece{Ticks{500 + static_cast<std::int64_t>(random() % 4000)}, {speed}, {}};
            tick_by_tick({start, at, piece}, [&](StepEdge step) { result.steps.push_back(step); });
            (void)frame.track.body.push_back(piece);
            start += piece.ticks;
            at = at + piece.covered();
        }
        result.frames.push_back(frame);
    }
    return result;
}

void order(DeviceDriver& driver, const Course& course) {
    ASSERT_TRUE(driver.apply(device::BeginRun{1}));
    for (const device::LoadFrame& frame : course.frames) { ASSERT_TRUE(driver.apply(frame)); }
    ASSERT_TRUE(driver.apply(device::Arm{course.frames.size()}));
}

/// The drivers give their orders at 1 s, or when the board has been found.
void expect_motion_over(LineFaults faults, std::uint64_t seed, std::uint32_t start_us = 4'000'000) {
    LinkedBoard board(faults, seed);
    const std::uint32_t found_us = start_us / 4;
    board.run(found_us);
    ASSERT_TRUE(board.is_found());
    std::vector<DeviceDriver> drivers{board.driver(0), board.driver(1)};
    const std::vector<Course> courses{course(seed, Tick{start_us}), course(seed + 100, Tick{start_us})};
    std::vector<std::vector<StepEdge>> made(kMotors);
    for (std::size_t n = 0; n < kMotors; ++n) {
        ASSERT_TRUE(drivers[n].set_up({}));
        order(drivers[n], courses[n]);
    }
    for (std::uint32_t until_us = found_us; until_us <= start_us + start_us / 2; until_us += 2000) {
        board.run(until_us);
        for (std::size_t n = 0; n < kMotors; ++n) {
            ASSERT_TRUE(drivers[n].drain_capture([&](StepEdge step) { made[n].push_back(step); }));
        }
    }
    for (std::size_t n = 0; n < kMotors; ++n) {
        const auto status = drivers[n].read();
        ASSERT_TRUE(status);
        EXPECT_TRUE(status->finished && !status->bad_segment && !status->in_tail);
        EXPECT_TRUE(made[n] == courses[n].steps) << made[n].size() << " steps, not " << courses[n].steps.size();
    }
}

TEST(LinkedBoard, MakesTheStepsOfItsDrivers) { expect_motion_over({}, 1); }

TEST(LinkedBoard, MakesTheSameStepsOverAPoorLine) { expect_motion_over({.damaged = 1, .lost = 1, .late = 5}, 2); }

/// Of all bytes 2.5 % are damaged, 2.5 % lost and 5 % late. All orders arrive within minutes, in parts.
TEST(LinkedBoard, MakesTheSameStepsOverALineThatSpoilsOrDelaysOneByteOfTen) {
    expect_motion_over({.damaged = 25, .lost = 25, .late = 50}, 3, 200'000'000);
}

/// Each third step makes a pulse. The next step is further away than it lasts.
TEST(FirmwareDevice, EndsEachPulseOfAPlaceAsManyTicksLaterAsTheSetupAsks) {
    constexpr Ticks kPulse{10};
    constexpr Piece kSteady{Ticks{20'000}, {std::numeric_limits<std::int64_t>::max() / 50}, {}};
    LinkedBoard board({}, 1);
    board.run(100'000);
    ASSERT_TRUE(board.is_found());
    DeviceDriver driver = board.driver(0);
    ASSERT_TRUE(driver.set_up({.compare_outputs = 1, .compare_pulse = kPulse}));
    ASSERT_TRUE(driver.apply(device::BeginRun{1}));
    ASSERT_TRUE(driver.apply(device::LoadFrame{1, Tick{200'000}, true, {rest_position(0, false), {kSteady}, {}}}));
    OutputTrack places;
    places.body.append({Ticks{1}, ComparePosition{.next = 3, .every = 3, .pulses = 1000}});
    ASSERT_TRUE(driver.apply(device::LoadOutputs{1, places}));
    ASSERT_TRUE(driver.apply(device::Arm{1}));
    board.run(250'000);
    std::vector<std::pair<Tick, std::uint16_t>> expected;
    std::int64_t count = 0;
    tick_by_tick({Tick{200'000}, rest_position(0, false), kSteady}, [&](StepEdge step) {
        if (++count % 3 != 0) { return; }
        expected.emplace_back(step.tick, std::uint16_t{1});
        expected.emplace_back(step.tick + kPulse, std::uint16_t{0});
    });
    EXPECT_GT(expected.size(), 100U);
    EXPECT_TRUE(board.changes(0) == expected) << board.changes(0).size() << " changes, not " << expected.size();
}

TEST(LinkedBoard, IsAskedForItsLightOnceForEachNumber) {
    LinkedBoard board({.damaged = 5, .lost = 5, .late = 10}, 4);
    board.run(1'000'000);
    ASSERT_TRUE(board.is_found());
    EXPECT_EQ(board.light_requests(), 0U);
    board.identify(1);
    board.run(2'000'000);
    EXPECT_EQ(board.light_requests(), 1U);
}

/// A message with any items, as a program would send it that does not know the map.
firmware::Message any_message(std::mt19937_64& random, std::uint16_t number) {
    firmware::Message message;
    firmware::store_bytes(message.bytes, 1, 4);
    firmware::store_bytes(message.bytes + 4, 2, 4);
    firmware::store_bytes(message.bytes + 8, number, 2);
    firmware::store_bytes(message.bytes + 10, random(), 2);
    message.size = firmware::kHeaderBytes + 6 + random() % (firmware::kMostMessageBytes - firmware::kHeaderBytes - 5);
    for (std::size_t at = firmware::kHeaderBytes; at < message.size; ++at) {
        message.bytes[at] = static_cast<std::uint8_t>(random());
    }
    message.bytes[firmware::kHeaderBytes] = static_cast<std::uint8_t>(random() % 3);
    message.bytes[firmware::kHeaderBytes + 1] = static_cast<std::uint8_t>(random() % 30);
    firmware::store_bytes(message.bytes + firmware::kHeaderBytes + 2, random() >> (47 + random() % 8), 4);
    return message;
}

TEST(LinkedBoard, ChangesNoWordOfADeviceForAnyMessage) {
    LinkedBoard board({}, 1);
    std::mt19937_64 random(1);
    std::vector<std::uint64_t> before;
    for (std::size_t word = 0; word < registers::kRunRequest; word += 8) { before.push_back(board.load(0, word)); }
    for (std::uint16_t number = 0; number < 20'000; ++number) { board.receive(any_message(random, number)); }
    for (std::size_t n = 0; n < before.size(); ++n) { ASSERT_EQ(board.load(0, n * 8), before[n]) << n; }
    EXPECT_NE(board.load(0, registers::kStepWidth), 0U) << "messages have arrived";
}

}  // namespace
}  // namespace lockstep::testing
