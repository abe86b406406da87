// Runs the simulated device of one motor in real time, and closes its inputs of probes where the machine's workpiece
// touches.
//
// The device's own slide is followed to 16 ticks. The others are where their processes published them last, at most a
// loop ago: a touch by their motion is seen so much later.
#pragma once

#include <expected>
#include <functional>
#include <string>

#include "sim_fpga/plant.hpp"
#include "sim_fpga/workpiece/shared_slides.hpp"
#include "sim_fpga/workpiece/work_contacts.hpp"

namespace lockstep {

class TouchedDevice {
public:
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
    WorkContacts contacts_;
    Tick now_;
};

}  // namespace lockstep
