// The watch doubts a device that contradicts itself, that has a stopped clock, or that does not end a run.
#include "core/axis/device/device_watch.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

/// Slots of 1 ms, ticks of 1 us. The watch tolerates 16 slots.
class Watch : public testing::Test {
protected:
    static MachineConfig machine() {
        MachineConfig machine;
        machine.timing.slot_us = 1000;
        machine.timing.freshness_slots = 2;
        return machine;
    }
    /// Looks at the device one loop later by both clocks.
    std::string look() {
        own_ += Ticks{500};
        shown_.now += Ticks{500};
        return look_at(shown_);
    }
    std::string look_at(const DeviceStatus& status) { return watch_.doubt_of(own_, status).value_or(""); }
    /// The time in ms until the watch doubts a device with a stopped clock, if it looks every `loop`.
    int patience(Ticks loop) {
        const Tick begun = own_;
        while (look_at(shown_).empty() && own_ - begun < Ticks{10'000'000}) { own_ += loop; }
        return static_cast<int>((own_ - begun).value / 1000);
    }
    void order_run(std::uint64_t run, Ticks lasts) {
        watch_.take(device::BeginRun{run});
        watch_.take(device::LoadFrame{1, shown_.now, true, {{}, {{lasts, {}, {}}}, {}}});
        shown_.run = shown_.run_asked = run;
        shown_.frame = 1;
    }

    DeviceWatch watch_{machine()};
    Tick own_{5'000'000};
    DeviceStatus shown_{.now = Tick{1'000'000}, .power_up = 7, .run = 3, .run_asked = 3};
};

TEST_F(Watch, BelievesADeviceThatCounts) {
    for (int loop = 0; loop < 100; ++loop) {
        EXPECT_EQ(look(), "");
        shown_.position = shown_.position + Displacement::steps(500);  // one pulse per tick
    }
}

/// The time begins when the device was found.
TEST_F(Watch, ToleratesADeviceThatHasNeverAnsweredForTheSameTime) {
    int ms = 0;
    std::string doubt;
    for (; doubt.empty() && ms < 1000; ++ms) {
        doubt = watch_.doubt_of_silence(own_).value_or("");
        own_ += Ticks{1000};
    }
    EXPECT_EQ(doubt, "it has not answered: its process, its board or the link to it has stopped");
    EXPECT_EQ(ms, 18);
}

TEST_F(Watch, ToleratesAStoppedClockOnlyForTheSilenceTime) {
    (void)look();
    EXPECT_EQ(patience(Ticks{500}), 16);
}

TEST_F(Watch, TimeInWhichTheProcessStalledDoesNotCount) {
    (void)look();
    EXPECT_EQ(patience(Ticks{100'000}), 1700) << "a slot for each of its loops";
}

TEST_F(Watch, ARunThatDoesNotEndIsNoticed) {
    (void)look();
    order_run(4, Ticks{2000});
    std::string doubt;
    int loops = 0;
    for (; doubt.empty() && loops < 1000; ++loops) { doubt = look(); }
    EXPECT_NE(doubt.find("run 4 has not ended"), std::string::npos) << doubt;
    EXPECT_EQ(loops, 2 * (2 + 16) + 1);
}

TEST_F(Watch, ARunThatEndsInTimeIsNot) {
    (void)look();
    order_run(4, Ticks{2000});
    shown_.finished = true;
    for (int loop = 0; loop < 1000; ++loop) { ASSERT_EQ(look(), ""); }
}

TEST_F(Watch, ARunThatIsNeverTakenIsNoticed) {
    (void)look();
    watch_.take(device::BeginRun{4});
    shown_.run_asked = 4;
    std::string doubt;
    for (int loop = 0; doubt.empty() && loop < 1000; ++loop) { doubt = look(); }
    EXPECT_NE(doubt.find("run 4 has not ended"), std::string::npos) << doubt;
}

TEST_F(Watch, AnotherPowerUpIsAnotherDevice) {
    (void)look();
    ++shown_.power_up;
    EXPECT_NE(look().find("powered up again"), std::string::npos);
}

TEST_F(Watch, DoubtsAClockThatGoesBack) {
    (void)look();
    shown_.now = shown_.now - Ticks{501};
    EXPECT_NE(look().find("its clock went back"), std::string::npos);
}

TEST_F(Watch, DoubtsACountFasterThanTheTicks) {
    (void)look();
    shown_.position = shown_.position - Displacement::steps(502);
    EXPECT_NE(look().find("its count changed from 0 to -502"), std::string::npos);
}

TEST_F(Watch, ARunThatWasNotOrderedIsRefuted) {
    (void)look();
    shown_.run_asked = 9;
    EXPECT_NE(look().find("reports an order for run 9"), std::string::npos);
    shown_.run_asked = 3;
    shown_.run = 9;
    EXPECT_NE(look().find("of run 9"), std::string::npos);
}

TEST_F(Watch, TheFrameOfTheRunBeforeIsShownUntilTheNewOneIsTaken) {
    shown_.frame = 7;
    EXPECT_EQ(look(), "");
    watch_.take(device::BeginRun{4});
    shown_.run_asked = 4;
    EXPECT_EQ(look(), "");
}

TEST_F(Watch, DoubtsAFrameThatWasNotLoaded) {
    (void)look();
    order_run(4, Ticks{2000});
    shown_.frame = 2;
    EXPECT_NE(look().find("reports frame 2 of run 4"), std::string::npos);
}

}  // namespace
}  // namespace lockstep
