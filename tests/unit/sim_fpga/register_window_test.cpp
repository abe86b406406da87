// One register map in this process's memory, in shared memory and in files.
#include "sim_fpga/register_window.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <csignal>

#include <fstream>
#include <thread>

#include "tests/unit/sim_fpga/device_bench.hpp"

namespace lockstep {
namespace {

std::string own_name(const std::string& what) { return "lockstep-test-" + what + "-" + std::to_string(::getpid()); }

bool mentions(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(RegisterWindow, TwoWindowsOnOneNameSeeTheSameWords) {
    auto made = RegisterWindow::create_shared(own_name("two"));
    ASSERT_TRUE(made) << made.error();
    auto opened = RegisterWindow::open_shared(own_name("two"));
    ASSERT_TRUE(opened) << opened.error();
    made->store(registers::kTick, 42);
    EXPECT_EQ(opened->load(registers::kTick), 42u);
    opened->store(registers::kWindowBytes - 8, 43);
    EXPECT_EQ(made->load(registers::kWindowBytes - 8), 43u);
}

TEST(RegisterWindow, ADeviceIsDrivenThroughAnotherWindowOnItsName) {
    DeviceBench bench(bench_axis(), {}, RegisterWindow::create_shared(own_name("drive")).value());
    auto host = DeviceDriver::attach(RegisterWindow::open_shared(own_name("drive")).value(), kTick_ns).value();
    ASSERT_TRUE(host.apply(device::BeginRun{1}));
    ASSERT_TRUE(host.apply(last_frame(1)));
    ASSERT_TRUE(host.apply(device::Arm{1}));
    bench.device.advance(Tick{100'000});
    EXPECT_EQ(host.read()->position, Position::steps(10));
}

TEST(RegisterWindow, ItsCreatorRemovesTheName) {
    { ASSERT_TRUE(RegisterWindow::create_shared(own_name("gone"))); }
    const auto opened = RegisterWindow::open_shared(own_name("gone"));
    ASSERT_FALSE(opened);
    EXPECT_TRUE(mentions(opened.error(), own_name("gone"))) << opened.error();
}

TEST(RegisterWindow, ANameThatALivingDeviceHoldsIsRefused) {
    const auto first = RegisterWindow::create_shared(own_name("held"));
    const auto second = RegisterWindow::create_shared(own_name("held"));
    ASSERT_FALSE(second);
    EXPECT_TRUE(mentions(second.error(), "in use")) << second.error();
    EXPECT_TRUE(RegisterWindow::open_shared(own_name("held"))) << "the first is not affected";
}

TEST(RegisterWindow, MemoryOfADeadDeviceIsReplaced) {
    const std::string path = "/dev/shm/" + own_name("dead");
    { std::ofstream(path) << "remains"; }
    const auto window = RegisterWindow::create_shared(own_name("dead"));
    ASSERT_TRUE(window) << window.error();
    EXPECT_EQ(window->load(0), 0u);
}

TEST(RegisterWindow, AFileTooShortForTheMapIsRefused) {
    const std::string path = ::testing::TempDir() + own_name("short");
    { std::ofstream(path) << "short"; }
    const auto window = RegisterWindow::open_file(path);
    ::unlink(path.c_str());
    ASSERT_FALSE(window);
    EXPECT_TRUE(mentions(window.error(), "shorter")) << window.error();
}

TEST(RegisterWindow, AMappedFileWorksToo) {
    const std::string path = ::testing::TempDir() + own_name("file");
    { std::ofstream(path) << std::string(registers::kWindowBytes, '\0'); }
    auto window = RegisterWindow::open_file(path);
    ::unlink(path.c_str());
    ASSERT_TRUE(window) << window.error();
    DeviceBench bench(bench_axis(), {}, *window);
    EXPECT_EQ(bench.at(Tick{5}).now, Tick{5});
}

/// Both sides access missing memory. Neither crashes, and both see that this is not a device.
TEST(RegisterWindow, AFileThatIsCutShortWhileItIsMappedReadsZeros) {
    for (const off_t left : {off_t{0}, off_t{4096}}) {  // with and without the page of the device's words
        DeviceBench bench(endless_axis(), {}, RegisterWindow::create_shared(own_name("cut")).value());
        auto host = DeviceDriver::attach(RegisterWindow::open_shared(own_name("cut")).value(), kTick_ns).value();
        ASSERT_TRUE(host.apply(device::BeginRun{1}));
        ASSERT_TRUE(host.apply(frame(1)));
        ASSERT_TRUE(host.apply(device::Arm{1}));
        EXPECT_TRUE(bench.device.is_intact());
        ASSERT_EQ(::truncate(("/dev/shm/" + own_name("cut")).c_str(), left), 0);
        bench.device.advance(kStart + kBody);
        (void)host.apply(frame(2));
        const auto look = host.read();
        ASSERT_FALSE(look);
        EXPECT_TRUE(mentions(look.error(), "MAGIC reads 0x0000000000000000")) << look.error();
        EXPECT_FALSE(bench.device.is_intact());
    }
}

TEST(RegisterWindow, OnlyTheWindowThatIsCutShortIsLost) {
    DeviceBench cut(bench_axis(), {}, RegisterWindow::create_shared(own_name("one")).value());
    DeviceBench whole(bench_axis(), {}, RegisterWindow::create_shared(own_name("other")).value());
    ASSERT_EQ(::truncate(("/dev/shm/" + own_name("one")).c_str(), 0), 0);
    cut.device.advance(Tick{5});
    EXPECT_FALSE(cut.device.is_intact());
    EXPECT_EQ(whole.at(Tick{5}).now, Tick{5});
    EXPECT_TRUE(whole.device.is_intact());
}

TEST(RegisterWindowDeathTest, AMissingPageOfAnythingElseEndsTheProcess) {
    const auto guarded = RegisterWindow::create_shared(own_name("guarded"));
    const std::string path = ::testing::TempDir() + own_name("else");
    const int file = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0600);
    ::unlink(path.c_str());
    auto* const words = static_cast<volatile int*>(::mmap(nullptr, 4096, PROT_READ, MAP_SHARED, file, 0));
    EXPECT_EXIT((void)*words, ::testing::KilledBySignal(SIGBUS), "");
    ::close(file);
}

TEST(RegisterWindow, ABadNameIsRefused) {
    EXPECT_FALSE(RegisterWindow::create_shared(""));
    EXPECT_FALSE(RegisterWindow::create_shared("a/b"));
    EXPECT_FALSE(RegisterWindow::open_shared("../etc"));
}

TEST(RegisterWindow, AReaderInAnotherThreadSeesConsistentStatesOnly) {
    DeviceBench bench(endless_axis());
    bench.order(device::BeginRun{1});
    const Ticks body{128 * 60'000};
    bench.order(device::LoadFrame{1, kStart, true, {Position::steps(0), {{body, kBenchSpeed, {}}}, {}}});
    bench.order(device::Arm{1});
    bench.at(Tick{0});
    std::jthread device([&](std::stop_token stop) {
        for (Tick now; now < kStart + body && !stop.stop_requested(); now += Ticks{50}) { bench.device.advance(now); }
        bench.device.advance(kStart + body);
    });
    DeviceStatus seen;
    while (!seen.finished) {
        const auto look = bench.driver.read();
        if (!look) {
            continue;  // the other thread was delayed for long
        }
        seen = *look;
        const Ticks run = seen.now < kStart ? Ticks{0} : seen.now - kStart;
        ASSERT_EQ(seen.position, (Position::steps(0) + Piece{body, kBenchSpeed, {}}.covered(run)));
        ASSERT_EQ(seen.encoder_count, seen.position.count());
    }
}

}  // namespace
}  // namespace lockstep
