// lockstep-fpga as a process: a host in another process moves its axis through shared memory.
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "services/axis/device_driver.hpp"

namespace lockstep {
namespace {

constexpr const char* kMachine = R"(
name: "bench"
axis {
  name: "X" steps_per_mm: 80 start_velocity_mm_s: 100 max_velocity_mm_s: 200 max_accel_mm_s2: 2000
  position_min_mm: 0 position_max_mm: 100
}
)";

/// A running program. The destructor sends SIGTERM if it has not ended.
class Process {
public:
    explicit Process(std::vector<std::string> words) {
        std::vector<char*> arguments;
        for (std::string& word : words) { arguments.push_back(word.data()); }
        arguments.push_back(nullptr);
        EXPECT_EQ(::posix_spawn(&pid_, arguments[0], nullptr, nullptr, arguments.data(), environ), 0);
    }
    ~Process() {
        if (pid_ > 0) { (void)end(); }
    }
    /// Its exit code after it has ended by itself.
    int wait() {
        int status = 0;
        ::waitpid(pid_, &status, 0);
        pid_ = 0;
        return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
    }
    int end() {
        ::kill(pid_, SIGTERM);
        return wait();
    }

private:
    pid_t pid_ = 0;
};

/// Repeats a check until it holds, for as long as a slow host may need.
bool eventually(const std::function<bool()>& holds) {
    for (int look = 0; look < 2000 && !holds(); ++look) { std::this_thread::sleep_for(std::chrono::milliseconds(5)); }
    return holds();
}

class FpgaProcess : public ::testing::Test {
protected:
    FpgaProcess() { std::ofstream(machine_) << kMachine; }
    ~FpgaProcess() override { ::unlink(machine_.c_str()); }

    std::vector<std::string> command(const std::string& axis = "X") const {
        return {LOCKSTEP_FPGA, "--machine", machine_, "--axis", axis, "--name", name_};
    }
    std::expected<DeviceDriver, std::string> attach() const {
        const auto window = RegisterWindow::open_shared(name_);
        return window ? DeviceDriver::attach(*window, 1000) : std::unexpected(window.error());
    }

    std::string name_ = "lockstep-test-process-" + std::to_string(::getpid());
    std::string machine_ = ::testing::TempDir() + name_ + ".textproto";
};

TEST_F(FpgaProcess, MakesEveryStepOfAFrameOnItsTickAndRemovesItsName) {
    Process fpga(command());
    ASSERT_TRUE(eventually([&] { return attach().has_value(); })) << attach().error();
    DeviceDriver driver = attach().value();
    ASSERT_TRUE(driver.set_up({}));

    constexpr Velocity kSpeed{std::int64_t{1} << 57};  // a step in 128 ticks, the first after 64
    const Tick start = driver.read()->now + Ticks{2'000'000};
    const AxisTrack track{Position::steps(0), {{Ticks{128 * 100}, kSpeed, {}}}, {}};
    ASSERT_TRUE(driver.apply(device::BeginRun{1}));
    ASSERT_TRUE(driver.apply(device::LoadFrame{1, start, true, track}));
    ASSERT_TRUE(driver.apply(device::Arm{1}));
    ASSERT_TRUE(eventually([&] { return driver.read()->finished; }));

    std::vector<StepEdge> steps;
    ASSERT_TRUE(driver.drain_capture([&](StepEdge step) { steps.push_back(step); }));
    ASSERT_EQ(steps.size(), 100u);
    for (std::int64_t k = 0; k < 100; ++k) {
        EXPECT_EQ(steps[static_cast<std::size_t>(k)], (StepEdge{start + Ticks{64 + 128 * k}, 1}));
    }
    EXPECT_EQ(driver.read()->encoder_count, 100);

    EXPECT_EQ(fpga.end(), 0);
    EXPECT_FALSE(RegisterWindow::open_shared(name_));
}

TEST_F(FpgaProcess, AnAxisThatIsNotInTheFileFails) { EXPECT_EQ(Process(command("Q")).wait(), 1); }

TEST_F(FpgaProcess, WrongUsageHasItsOwnExitCode) { EXPECT_EQ(Process({LOCKSTEP_FPGA, "--speed", "9"}).wait(), 2); }

}  // namespace
}  // namespace lockstep
