// The device of an axis is searched for, found, and lost.
#include "services/axis/axis_device.hpp"

#include <gmock/gmock.h>

namespace lockstep {
namespace {

using testing::HasSubstr;

/// What a device shows, and what it was ordered.
struct Shown {
    Tick now{1000};
    std::string error;
    std::string refusal;
    std::vector<DeviceOrder> orders;
    std::uint64_t lost_captures = 0;
};

class ShownPort final : public DevicePort {
public:
    explicit ShownPort(Shown& shown) : shown_(shown) {}
    DeviceClock clock() const override { return DeviceClock::Own; }
    std::expected<std::optional<DeviceReading>, std::string> read(Tick own) override {
        if (!shown_.error.empty()) { return std::unexpected(shown_.error); }
        return DeviceReading{.status = {.now = shown_.now}, .asked = own, .answered = own};
    }
    std::expected<void, std::string> apply(const DeviceOrder& order) override {
        shown_.orders.push_back(order);
        if (!shown_.refusal.empty()) { return std::unexpected(shown_.refusal); }
        return {};
    }
    std::expected<std::uint32_t, std::string> drain(const OnStep&) override { return 7; }
    std::uint64_t lost_captures() const override { return shown_.lost_captures; }
    std::expected<void, std::string> drain_channels(const OnChannel&) override { return {}; }
    std::uint64_t lost_channel_events() const override { return 0; }

private:
    Shown& shown_;
};

class FoundDevice : public testing::Test {
protected:
    static constexpr Ticks kLoop{1000};

    /// One loop, in which the device's clock advances.
    void pass(Ticks time = kLoop) {
        own += time;
        shown.now += time;
        device.seek(own);
        device.read(own);
    }
    void find() {
        pass();
        pass();
        ASSERT_TRUE(device.is_present());
    }

    MachineConfig machine{.name = "one"};
    Shown shown;
    bool exists = true;
    int searches = 0;
    Tick own{50'000};
    AxisDevice device{machine, [this](Tick) -> std::expected<std::unique_ptr<DevicePort>, std::string> {
                          ++searches;
                          if (!exists) { return std::unexpected("no such device"); }
                          return std::make_unique<ShownPort>(shown);
                      }};
};

TEST_F(FoundDevice, IsPresentOnlyWhenItsClockAdvances) {
    pass();
    EXPECT_TRUE(device.is_in_doubt());
    EXPECT_FALSE(device.clock());
    pass();
    EXPECT_TRUE(device.is_present());
    EXPECT_TRUE(device.take_change());
    EXPECT_FALSE(device.take_change()) << "once";
    ASSERT_TRUE(device.clock());
    EXPECT_EQ(device.clock()->reading->received, shown.now);
}

TEST_F(FoundDevice, IsSearchedForAgainAfterAPauseIfItIsMissing) {
    exists = false;
    pass();
    pass();
    EXPECT_EQ(searches, 1);
    EXPECT_EQ(device.lacks(), "no such device");
    pass(Ticks{200'000});
    EXPECT_EQ(searches, 2);
}

TEST_F(FoundDevice, IsOrderedToRestBeforeItIsLost) {
    find();
    (void)device.take_change();
    shown.error = "magic is 0";
    pass();
    EXPECT_FALSE(device.is_present());
    EXPECT_TRUE(device.take_change());
    ASSERT_EQ(shown.orders.size(), 1U);
    EXPECT_TRUE(std::holds_alternative<device::Veto>(shown.orders[0]));
    EXPECT_EQ(device.lacks(), "magic is 0");
    EXPECT_EQ(device.troubles(), 1U);
    EXPECT_TRUE(device.status().finished);
}

TEST_F(FoundDevice, AnOrderThatItRefusesIsATroubleButDoesNotLoseIt) {
    find();
    shown.refusal = "the frame has no body";
    device.give({device::BeginRun{}});
    EXPECT_TRUE(device.is_present());
    EXPECT_EQ(device.trouble(), "the frame has no body");
    EXPECT_TRUE(device.take_failure());
    EXPECT_FALSE(device.take_failure()) << "once";
}

TEST_F(FoundDevice, StepsLostByFormerDevicesStillCount) {
    find();
    shown.lost_captures = 3;
    EXPECT_EQ(device.drain(own, [](StepEdge) {}), 7U);
    shown.error = "gone";
    pass();
    EXPECT_EQ(device.drain(own, [](StepEdge) {}), std::nullopt);
    EXPECT_EQ(device.lost_captures(), 3U);
}

}  // namespace
}  // namespace lockstep
