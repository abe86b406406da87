// sim_fpga/rtl/axis/axis_pins.v: what a driver sees at its pins, clock by clock.
#include <gtest/gtest.h>

#include <cstdint>
#include <deque>
#include <random>

#include "Vaxis_pins.h"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {
namespace {

constexpr std::int64_t kTick = 24;  // clocks
constexpr std::int64_t kLongAgo = -1'000'000;

struct Times {
    std::int64_t width;
    std::int64_t setup;
    std::int64_t hold;
};

/// The pins, and the steps that have not come to them yet.
class Driver {
public:
    Driver(const Times& times, unsigned inverted) : times_(times), inverted_(inverted) {
        auto& pins = hardware_.pins;
        pins.tick = pins.step = pins.forward = pins.enabled = 0;
        pins.step_width = static_cast<std::uint16_t>(times.width);
        pins.direction_setup = static_cast<std::uint16_t>(times.setup);
        pins.direction_hold = static_cast<std::uint16_t>(times.hold);
        pins.inverted = static_cast<std::uint8_t>(inverted);
        for (int i = 0; i < 4; ++i) { hardware_.clock(); }
    }

    /// A tick with this step, which is known some clocks after its beginning.
    void tick(int step, std::int64_t known) {
        for (std::int64_t clock = 0; clock < kTick; ++clock) {
            hardware_.pins.tick = clock == 0;
            hardware_.pins.step = step != 0 && clock == known;
            hardware_.pins.forward = step > 0;
            if (clock == 0 && waiting_ != 0) { expected_.push_back({waiting_, now_ + times_.setup}); }
            if (clock == 0) { waiting_ = step; }
            hardware_.clock();
            ++now_;
            look();
        }
    }
    bool all_came() const { return expected_.empty() && waiting_ == 0; }
    int pulses() const { return pulses_; }
    int late() const { return late_; }

private:
    struct Expected {
        int step;
        std::int64_t at;  // if it is in time, but for a constant
    };
    void look() {
        const bool is_on = (hardware_.pins.step_pin ^ (inverted_ & 1)) != 0;
        const bool forward = (hardware_.pins.direction_pin ^ (inverted_ >> 1 & 1)) != 0;
        if (forward != forward_) {
            ASSERT_GE(now_ - began_, times_.hold) << "the direction is not held";
            turned_ = now_;
        }
        if (is_on && !is_on_) { begin(forward); }
        if (!is_on && is_on_) {
            ASSERT_EQ(now_ - began_, times_.width);
            ended_ = now_;
        }
        is_on_ = is_on;
        forward_ = forward;
    }
    void begin(bool forward) {
        constexpr std::int64_t kConstant = 5;  // of the pins' registers
        ASSERT_GE(now_ - turned_, times_.setup) << "the direction is not there before the pulse";
        ASSERT_GE(now_ - ended_, times_.width) << "the pause is too short";
        ASSERT_FALSE(expected_.empty()) << "a pulse without a step";
        ASSERT_EQ(forward, expected_.front().step > 0);
        ASSERT_GE(now_, expected_.front().at + kConstant);
        late_ += now_ > expected_.front().at + kConstant ? 1 : 0;
        expected_.pop_front();
        ++pulses_;
        began_ = now_;
    }

    Times times_;
    unsigned inverted_;
    Clocked<Vaxis_pins> hardware_;
    std::deque<Expected> expected_;
    int waiting_ = 0;
    std::int64_t now_ = 0;
    std::int64_t turned_ = kLongAgo;
    std::int64_t began_ = kLongAgo;
    std::int64_t ended_ = kLongAgo;
    bool is_on_ = false;
    bool forward_ = false;
    int pulses_ = 0;
    int late_ = 0;
};

/// Steps at drawn ticks. `least`: ticks from one step to the next; `least_turn`: if their directions differ.
void step_at_random(Driver& driver, std::mt19937_64& draw, std::int64_t least, std::int64_t least_turn) {
    std::int64_t since = 1'000;
    int last = 1;
    for (int i = 0; i < 20'000 && !::testing::Test::HasFatalFailure(); ++i) {
        const int direction = draw() % 8 == 0 ? -last : last;
        const bool may = since >= (direction == last ? least : least_turn);
        const int step = may && draw() % 3 != 0 ? direction : 0;
        driver.tick(step, 1 + static_cast<std::int64_t>(draw() % (kTick - 1)));
        since = step != 0 ? 1 : since + 1;
        last = step != 0 ? step : last;
    }
    for (int i = 0; i < 200; ++i) { driver.tick(0, 1); }
}

TEST(AxisPins, MakeEachPulseAConstantTimeAfterItsTickIfTheStepsLeaveTimeForIt) {
    std::mt19937_64 draw(5);
    for (const Times times : {Times{20, 100, 30}, Times{1, 0, 0}, Times{24, 24, 24}, Times{7, 3, 200}}) {
        Driver driver(times, static_cast<unsigned>(draw() % 8));
        step_at_random(driver, draw, 2 + times.width * 2 / kTick, 2 + (times.setup + times.hold) / kTick);
        EXPECT_TRUE(driver.all_came());
        EXPECT_GT(driver.pulses(), 2'000);
        EXPECT_EQ(driver.late(), 0);
    }
}

TEST(AxisPins, KeepTheTimesOfTheDriverAndLoseNoStepIfTheStepsLeaveNoTime) {
    std::mt19937_64 draw(6);
    Driver driver({20, 50, 30}, 0);
    step_at_random(driver, draw, 2, 2);
    EXPECT_TRUE(driver.all_came());
    EXPECT_GT(driver.pulses(), 2'000);
    EXPECT_GT(driver.late(), 100);
}

}  // namespace
}  // namespace lockstep::rtl
