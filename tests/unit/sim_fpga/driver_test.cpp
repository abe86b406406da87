// A driver works with the device it was built for, and checks every window.
#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

std::string attach_error(const RegisterWindow& window, std::int64_t tick_ns = kTick_ns) {
    const auto driver = DeviceDriver::attach(window, tick_ns);
    return driver ? "" : driver.error();
}

TEST(Driver, RefusesMemoryThatIsNoDevice) {
    const std::string error = attach_error(RegisterWindow::in_process());
    EXPECT_EQ(error,
              "device: MAGIC reads 0x0000000000000000, expected 0x4C4F434B53544550; "
              "check that this is a Lockstep axis device and that it has power");
}

TEST(Driver, RefusesAnotherVersionAndAnotherMap) {
    DeviceBench bench;
    bench.window.store(registers::kMapChecksum, 7);
    EXPECT_NE(attach_error(bench.window).find("MAP_CHECKSUM reads 0x0000000000000007"), std::string::npos);
    bench.window.store(registers::kVersion, 99);
    EXPECT_NE(attach_error(bench.window).find("VERSION reads 0x0000000000000063"), std::string::npos);
}

TEST(Driver, RefusesImpossibleAbilities) {
    for (const std::uint64_t entries : {0u, 8u, 1000u, 8192u}) {
        DeviceBench bench;
        bench.window.store(registers::kSegmentEntries, entries);
        EXPECT_NE(attach_error(bench.window).find("SEGMENT_ENTRIES reads"), std::string::npos) << entries;
    }
    for (const std::uint64_t entries : {0u, 128u, 65'535u, 131'072u}) {
        DeviceBench bench;
        bench.window.store(registers::kCaptureEntries, entries);
        EXPECT_NE(attach_error(bench.window).find("CAPTURE_ENTRIES reads"), std::string::npos) << entries;
    }
}

TEST(Driver, RefusesImpossibleNumbersOfTicks) {
    const auto error_with = [](std::size_t word, std::uint64_t ticks) {
        DeviceBench bench;
        bench.window.store(word, ticks);
        return attach_error(bench.window);
    };
    EXPECT_EQ(error_with(registers::kLongestPieceTicks, 0),
              "device: LONGEST_PIECE_TICKS reads 0x0000000000000000, expected 1 to 4398046511104; restart the device");
    EXPECT_NE(error_with(registers::kLeastStepTicks, 0).find("LEAST_STEP_TICKS reads"), std::string::npos);
    EXPECT_NE(error_with(registers::kLeadTicks, ~std::uint64_t{0}).find("LEAD_TICKS reads"), std::string::npos);
    EXPECT_NE(error_with(registers::kPinTicks, ~std::uint64_t{0}).find("PIN_TICKS reads"), std::string::npos);
}

TEST(Driver, RefusesAFrameWithAPieceThatIsTooLongForTheDevice) {
    DeviceBench bench(bench_axis(), {.longest_piece = kBody});
    bench.order(device::BeginRun{1});
    bench.order(last_frame(1));
    device::LoadFrame longer = last_frame(2);
    longer.track.body[0].ticks += Ticks{1};
    EXPECT_EQ(bench.driver.apply(longer).error(),
              "device: frame 2 is not loaded: a piece has 1281 ticks, but the device's have at most 1280");
}

TEST(Driver, ADeviceThatHasLostTicksIsUsedNoMore) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(device::Arm{1});
    EXPECT_TRUE(bench.at(kStart + Ticks{500}).moving);
    bench.device.lose_ticks();
    bench.device.advance(kStart + Ticks{600});
    EXPECT_EQ(bench.window.load(registers::kStatus) & (registers::kStatusMoving | registers::kStatusLostTicks),
              registers::kStatusLostTicks);
    const auto read = bench.driver.read();
    ASSERT_FALSE(read);
    EXPECT_NE(read.error().find("LOST_TICKS"), std::string::npos) << read.error();
    EXPECT_EQ(attach_error(bench.window), read.error()) << "until it is powered up again";
}

TEST(Driver, ReadsWhatTheDeviceIsBuiltFor) {
    const DeviceAbilities small{.segment_entries = 16,
                                .capture_entries = 256,
                                .least_step = Ticks{5},
                                .longest_piece = Ticks{1000},
                                .lead = Ticks{128},
                                .behind = Ticks{1168},
                                .longest_pwm_period = 7,
                                .frames_stay = true};
    EXPECT_EQ(DeviceBench(bench_axis(), small).driver.abilities(), small);
}

TEST(Driver, RefusesAnotherTick) {
    DeviceBench bench;
    EXPECT_NE(attach_error(bench.window, 500).find("the same tick_ns"), std::string::npos);
}

TEST(Driver, ContinuesWhereItsPredecessorStopped) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(frame(1));
    bench.order(device::Arm{1});
    bench.at(kStart + kBody);
    EXPECT_EQ(bench.steps().size(), 10u);
    bench.driver = DeviceDriver::attach(bench.window, kTick_ns).value();
    const DeviceStatus after = bench.at(Tick{100'000});
    EXPECT_EQ(after.position.count(), 11);
    EXPECT_EQ(bench.steps().size(), 1u) << "the steps not drained before, and no others";
}

TEST(Driver, AWildRingEndIsAnErrorNotACrash) {
    DeviceBench bench;
    bench.window.store(registers::kCaptureHead, ~std::uint64_t{0} / 2);
    EXPECT_FALSE(bench.driver.drain_capture([](StepEdge) { FAIL(); }));
    bench.window.store(registers::kSegmentTail, 12'345);
    EXPECT_FALSE(bench.driver.read());
    EXPECT_FALSE(bench.driver.apply(frame(1)));
    EXPECT_NE(attach_error(bench.window).find("segment ring"), std::string::npos);
}

TEST(Driver, MemoryThatNoLongerShowsTheDeviceIsAnError) {
    for (const std::size_t word :
         {registers::kMagic, registers::kVersion, registers::kMapChecksum, registers::kTickNs}) {
        DeviceBench bench;
        ASSERT_TRUE(bench.driver.read());
        bench.window.store(word, 7);
        EXPECT_FALSE(bench.driver.read()) << word;
        EXPECT_FALSE(bench.device.is_intact()) << word;
    }
}

TEST(Driver, ImpossibleCapturedTicksAreNotPassedOn) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(last_frame(1));
    bench.order(device::Arm{1});
    bench.at(Tick{100'000});
    const std::size_t third = registers::kCaptureRing + 2 * registers::kCaptureRingEntryBytes;
    for (const std::uint64_t tick : {std::uint64_t{5}, std::uint64_t{100'001}, ~std::uint64_t{0} >> 1}) {
        DeviceDriver driver = DeviceDriver::attach(bench.window, kTick_ns).value();
        bench.window.store(third, tick << 1);
        int steps = 0;
        EXPECT_FALSE(driver.drain_capture([&](StepEdge) { ++steps; })) << tick;
        EXPECT_EQ(steps, 2) << tick;
    }
}

TEST(Driver, AnOldStepIsNotPassedOnAgain) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(last_frame(1));
    bench.order(device::Arm{1});
    bench.at(Tick{100'000});
    EXPECT_EQ(bench.steps().size(), 10u);
    bench.window.store(registers::kCaptureTail, 0);
    EXPECT_FALSE(bench.driver.drain_capture([](StepEdge) { FAIL(); }));
}

TEST(Driver, ADeviceHeldUpInAnUpdateIsReadAsBefore) {
    DeviceBench bench;
    bench.at(Tick{5});
    bench.window.store(registers::kSequence, 7);
    bench.window.store(registers::kTick, 6);
    EXPECT_EQ(bench.driver.read()->now, Tick{5});
    EXPECT_EQ(bench.at(Tick{8}).now, Tick{8}) << "and its current state once it continues";
}

TEST(Driver, ADeviceThatDiedInAnUpdateIsAnErrorNotAWaitForEver) {
    DeviceBench bench;
    bench.at(Tick{5});
    bench.window.store(registers::kSequence, 7);
    for (int read = 0; read < DeviceDriver::kMaxStaleReads; ++read) { ASSERT_TRUE(bench.driver.read()); }
    const auto status = bench.driver.read();
    ASSERT_FALSE(status);
    EXPECT_NE(status.error().find("in the middle of an update"), std::string::npos) << status.error();
}

TEST(Driver, AnArmedFrameIsNotDisarmedByALaterLowerOneNorAVetoLifted) {
    DeviceBench bench;
    bench.order(device::BeginRun{1});
    bench.order(device::Arm{3});
    bench.order(device::Arm{2});
    bench.order(device::Veto{4});
    bench.order(device::Veto{5});
    EXPECT_EQ(bench.window.load(registers::kArmed), 3u);
    EXPECT_EQ(bench.window.load(registers::kVeto), 4u);
}

}  // namespace
}  // namespace lockstep
