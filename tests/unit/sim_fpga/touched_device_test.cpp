// Simulated devices in several processes whose slides move one axis: its switch is wired to one of them.
#include "sim_fpga/contacts/touched_device.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>

#include "core/kinematics/motors.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kBelts = 0;  // the domain
constexpr unsigned kChannel = 3;
constexpr double kStart_mm = 3;
constexpr double kSwitch_mm = -1;
constexpr double kStepsPerMm = 80;
constexpr double kStepsPerTick = -2 * kStepsPerMm * 1e-6;  // 2 mm/s, 1 us a tick
constexpr Ticks kLoop{60'000};

AxisConfig belt(const std::string& name, const std::string& motor) {
    AxisConfig axis{.name = name, .device = {}};
    axis.steps_per_mm = kStepsPerMm;
    axis.start_velocity_mm_s = 20;
    axis.max_velocity_mm_s = 120;
    axis.max_accel_mm_s2 = axis.max_decel_mm_s2 = 1500;
    axis.position_max_mm = 100;
    axis.plant.start_position_mm = kStart_mm;
    axis.plant.travel_margin_mm = 8;
    axis.motors.push_back({.name = motor, .device = {}});
    return axis;
}

/// Its name is that of this process alone, as tests run at the same time.
MachineConfig core_xy() {
    MachineConfig machine{.name = "touched-" + std::to_string(::getpid())};
    machine.axes = {belt("X", "A"), belt("Y", "B")};
    machine.kinematics.core_xy = {.first = "X", .second = "Y"};
    HomingConfig& homing = machine.axes[0].homing;
    homing.way = HomingWay::ByTouch;
    homing.input = "x_home";
    homing.switch_position_mm = kSwitch_mm;
    machine.inputs.push_back({.name = "x_home", .motor = "B", .channel = kChannel, .use = InputUse::Home});
    return machine;
}

/// A belt that goes steadily, simulated by a process of its own.
class Belt {
public:
    Belt(const MachineConfig& machine, std::size_t motor)
        : plant_(plant_of(machine, motors_of(machine)[MotorIndex{motor}])),
          device_(TouchedDevice::open(machine, kBelts, MotorIndex{motor}, Tick{}).value()) {}

    void advance(Tick until) {
        device_.advance(until, plant_, [this](Tick at) { run(at); });
    }
    bool is_closed() const { return (plant_.pins() >> kChannel & 1U) != 0; }
    std::int64_t slide() const { return plant_.slide(); }
    /// Where the slide was when the switch closed.
    std::optional<std::int64_t> closed_at() const { return closed_at_; }

private:
    void run(Tick at) {
        if (is_closed() && !closed_at_) { closed_at_ = plant_.slide(); }
        const auto wanted = std::llround(kStepsPerTick * static_cast<double>(at.value));
        if (wanted != plant_.slide()) { plant_.push(wanted - plant_.slide()); }
    }

    Plant plant_;
    TouchedDevice device_;
    std::optional<std::int64_t> closed_at_;
};

/// Both belts go equally far, so X goes as far as each of them.
TEST(TouchedDevice, ClosesASwitchOfAnAxisThatAnotherProcessMovesToo) {
    const MachineConfig machine = core_xy();
    ASSERT_TRUE(TouchedDevice::is_needed(machine));
    Belt a(machine, 0);
    Belt b(machine, 1);
    for (Tick now{}; !b.is_closed() && now < Tick{5'000'000}; now += kLoop) {
        b.advance(now);
        a.advance(now);
    }
    ASSERT_TRUE(b.closed_at());
    EXPECT_NEAR(static_cast<double>(*b.closed_at()), (kSwitch_mm - kStart_mm) * kStepsPerMm, 1);
    EXPECT_FALSE(a.is_closed()) << "the switch is at the other device";
}

TEST(TouchedDevice, OfABeltThatIsNoLongerSimulatedStandsWhereItWas) {
    const MachineConfig machine = core_xy();
    Belt a(machine, 0);
    Belt b(machine, 1);
    for (Tick now{}; now < Tick{1'000'000}; now += kLoop) {
        b.advance(now);
        a.advance(now);
    }
    const auto slides = SharedSlides::open(machine, kBelts).value();
    const auto place_after = [&](double seconds) {
        return slides.places(Tick{960'000} + Ticks{std::llround(seconds * 1e6)})[MotorIndex{0}];
    };
    const double step = 1 / std::abs(kStepsPerTick) * 1e-6;
    EXPECT_EQ(place_after(0).count() - place_after(3 * step).count(), 3);
    EXPECT_EQ(place_after(2), place_after(0));
}

}  // namespace
}  // namespace lockstep
