// Runs the simulated device of one motor in real time, and closes those of its inputs that slides of the machine touch:
// switches of axes, and probes at the machine's workpiece.
//
// The device's own slide is followed to 16 ticks. The others count on from where their processes published them last,
// at most a loop ago, at the mean speed that they had: to about a step, unless they begin to move or turn in that time.
#pragma once

#include <expected>
#include <functional>
#include <string>

#include "sim_fpga/contacts/shared_slides.hpp"
#include "sim_fpga/contacts/slide_contacts.hpp"
#include "sim_fpga/plant.hpp"

namespace lockstep {

class TouchedDevice {
public:
    /// Whether slides of the machine touch something, so that its simulated devices need this.
    static bool is_needed(const MachineConfig& machine) { return !SlideContacts(machine).none(); }
    /// The device is at `now`. `domain` and error: those of SharedSlides::open.
    static std::expected<TouchedDevice, std::string> open(const MachineConfig& machine, std::uint32_t domain,
                                                          MotorIndex motor, Tick now);

    /// Runs the device up to `until` by run(tick), which advances it and its plant.
    void advance(Tick until, Plant& plant, const std::function<void(Tick)>& run);

private:
    TouchedDevice(const MachineConfig& machine, MotorIndex motor, SharedSlides slides, Tick now);
    void look(Tick at, Plant& plant, const std::function<void(Tick)>& run);

    std::vector<InputConfig> inputs_;  // of the machine
    MotorIndex motor_;
    SharedSlides slides_;
    SlideContacts contacts_;
    SlideSpeed speed_;
    double steps_per_tick_ = 0;
    Tick now_;
};

}  // namespace lockstep
