#include "services/virtual/late_link.hpp"

#include <gmock/gmock.h>

#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr LinkDelay kLink{{100}, {5000}};
constexpr Ticks kLater{20'000};

device::LoadFrame later(device::LoadFrame frame) {
    frame.start += kLater;
    return frame;
}

/// A device that shows the true time, at the end of a link, and a process whose clock is an hour ahead.
class LinkedDevice : public testing::Test {
protected:
    static constexpr Ticks kAhead{3'600'000'000};

    LinkedDevice() { link_.attach(DeviceDriver::attach(bench_.window, kTick_ns).value()); }

    void advance(Ticks by) {
        const Tick until = now_ + by;
        for (auto at = link_.next(); at && *at <= until; at = link_.next()) {
            (void)bench_.at(*at);
            link_.arrive();
        }
        (void)bench_.at(until);
        now_ = until;
    }
    std::expected<std::optional<DeviceReading>, std::string> read() { return port_.read(now_ + kAhead); }
    DeviceReading answered() {
        (void)read();
        advance(kLink.most);
        return read().value().value();
    }

    DeviceBench bench_;
    LateLink link_{kLink, 7};
    Tick now_{500};
    LatePort port_{link_, [this] { return now_; }, [](Tick at) { return at + kAhead; }};
};

TEST_F(LinkedDevice, HasNoReadingBeforeItsFirstAnswer) {
    EXPECT_FALSE(read().value());
    advance(kLink.most);
    EXPECT_TRUE(read().value());
}

TEST_F(LinkedDevice, EachReadingIsOfAnInstantOfItsInterval) {
    Tick last;
    int different = 0;
    for (int i = 0; i < 2000; ++i) {
        advance(Ticks{500});
        const auto reading = read().value();
        if (!reading) { continue; }
        const Tick made = reading->status.now + kAhead;
        ASSERT_LE(reading->asked, made);
        ASSERT_GE(reading->answered, made);
        ASSERT_GE(reading->answered - reading->asked, kLink.least);
        ASSERT_LE(reading->answered - reading->asked, kLink.most);
        ASSERT_LE(reading->answered, now_ + kAhead) << "it has arrived";
        different += last == reading->status.now ? 0 : 1;
        last = reading->status.now;
    }
    EXPECT_GT(different, 300);
}

TEST_F(LinkedDevice, OrdersArriveInOrderAndTheRoomThatTheyTakeCountsAtOnce) {
    const DeviceReading before = answered();
    port_.apply(device::BeginRun{1}).value();
    port_.apply(later(frame(1))).value();
    port_.apply(later(frame(2))).value();
    port_.apply(device::Arm{2}).value();
    const DeviceReading still = read().value().value();
    EXPECT_EQ(still.asked, before.asked) << "the same answer";
    EXPECT_EQ(still.status.run_asked, 1u);
    EXPECT_EQ(still.status.free_segments, before.status.free_segments - 6) << "two pieces and a header for each";
    advance(kLink.most);
    EXPECT_EQ(bench_.window.load(registers::kArmed), 2u);
    EXPECT_EQ(answered().status.free_segments, before.status.free_segments - 6) << "two pieces and a header for each";
}

TEST_F(LinkedDevice, StepsComeWithTheAnswerThatCountsThem) {
    (void)answered();
    for (const DeviceOrder& order :
         {DeviceOrder(device::BeginRun{1}), DeviceOrder(later(last_frame(1))), DeviceOrder(device::Arm{1})}) {
        port_.apply(order).value();
    }
    std::int64_t drained = 0;
    const auto count = [&](StepEdge step) { drained += step.direction; };
    for (int i = 0; i < 400; ++i) {
        advance(Ticks{100});
        const DeviceReading reading = read().value().value();
        (void)port_.drain(count);
        ASSERT_EQ(drained, reading.status.position.count());
    }
    EXPECT_EQ(drained, 10);
}

TEST_F(LinkedDevice, ARefusedOrderIsReportedByALaterReading) {
    (void)answered();
    EXPECT_TRUE(port_.apply(frame(1))) << "the device has not refused it yet";
    (void)read();
    advance(kLink.most + kLink.most);
    (void)read();
    advance(kLink.most);
    EXPECT_THAT(read().error(), HasSubstr("no run has been begun"));
}

TEST_F(LinkedDevice, AnswersNothingWhileItsDeviceTakesNoMessage) {
    const DeviceReading before = answered();
    link_.hold_until(now_ + Ticks{50'000});
    advance(Ticks{50'000} - Ticks{1});
    EXPECT_EQ(read().value()->asked, before.asked);
    advance(kLink.most);
    EXPECT_GT(read().value()->asked, before.asked);
}

}  // namespace
}  // namespace lockstep
