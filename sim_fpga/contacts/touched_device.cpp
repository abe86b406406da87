#include "sim_fpga/contacts/touched_device.hpp"

#include <algorithm>
#include <utility>

#include "core/kinematics/motors.hpp"

namespace lockstep {

std::expected<TouchedDevice, std::string> TouchedDevice::open(const MachineConfig& machine, std::uint32_t domain,
                                                              MotorIndex motor, Tick now) {
    auto slides = SharedSlides::open(machine, domain);
    if (!slides) { return std::unexpected(slides.error()); }
    return TouchedDevice(machine, motor, std::move(*slides), now);
}

TouchedDevice::TouchedDevice(const MachineConfig& machine, MotorIndex motor, SharedSlides slides, Tick now)
    : inputs_(machine.inputs),
      motor_(motor),
      slides_(std::move(slides)),
      contacts_(machine, motor_name(machine, motor)),
      now_(now) {}

void TouchedDevice::advance(Tick until, Plant& plant, const std::function<void(Tick)>& run) {
    constexpr Ticks kLook{16};
    constexpr std::int64_t kMostLooks = 1000;
    const Ticks look_every{std::max(kLook.value, (until - now_).value / kMostLooks)};
    const bool may_change = contacts_.may_change_within(until - now_);
    for (Tick at = now_ + look_every; may_change && at < until; at += look_every) { look(at, plant, run); }
    look(until, plant, run);
    steps_per_tick_ = speed_.look(plant.slide(), until);
    now_ = until;
}

void TouchedDevice::look(Tick at, Plant& plant, const std::function<void(Tick)>& run) {
    run(at);
    slides_.publish(motor_, {plant.slide(), at, steps_per_tick_});
    if (contacts_.none()) { return; }
    contacts_.follow(slides_.places(at),
                     [&](std::size_t input, bool closed) { set_contact(plant, inputs_[input], closed); });
}

}  // namespace lockstep
