// The places of simulated slides in memory that the processes of a machine share.
#include "sim_fpga/contacts/shared_slides.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <optional>

namespace lockstep {
namespace {

constexpr std::uint32_t kDomain = 0;

/// Its name is that of this process alone, as tests run at the same time.
MachineConfig machine() {
    MachineConfig machine{.name = "slides-" + std::to_string(::getpid())};
    machine.axes.resize(2);
    machine.axes[0].name = "X";
    machine.axes[1].name = "Y";
    for (AxisConfig& axis : machine.axes) { axis.steps_per_mm = 100; }
    return machine;
}

bool exists(const MachineConfig& machine) {
    const int file = ::shm_open(SharedSlides::name_of(machine.name, kDomain).c_str(), O_RDONLY | O_CLOEXEC, 0);
    if (file >= 0) { ::close(file); }
    return file >= 0;
}

TEST(SharedSlides, OneProcessSeesWhatAnotherPublishes) {
    const MachineConfig config = machine();
    auto first = SharedSlides::open(config, kDomain);
    auto second = SharedSlides::open(config, kDomain);
    ASSERT_TRUE(first && second);
    const std::int64_t start = second->places(Tick{})[1].count();
    first->publish(MotorIndex{1}, {.steps = 250});
    EXPECT_EQ(second->places(Tick{})[1].count(), start + 250);
}

TEST(SharedSlides, TheLastOneThatClosesTheMemoryRemovesIt) {
    const MachineConfig config = machine();
    std::optional first = SharedSlides::open(config, kDomain);
    std::optional second = SharedSlides::open(config, kDomain);
    ASSERT_TRUE(*first && *second);
    first.reset();
    EXPECT_TRUE(exists(config));
    second.reset();
    EXPECT_FALSE(exists(config));
}

TEST(SharedSlides, AMachineThatIsUpAgainStartsWithSlidesAtTheirStarts) {
    const MachineConfig config = machine();
    const std::int64_t start = SharedSlides::open(config, kDomain)->places(Tick{})[0].count();
    SharedSlides::open(config, kDomain)->publish(MotorIndex{0}, {.steps = 400});
    EXPECT_EQ(SharedSlides::open(config, kDomain)->places(Tick{})[0].count(), start);
}

}  // namespace
}  // namespace lockstep
