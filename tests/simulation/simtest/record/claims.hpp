// Checks that each axis reports the truth: compares every one of its states with its pulses and its slide.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/coordinator/homing/touch_homing.hpp"
#include "core/kinematics/motors.hpp"
#include "core/protocol/rules.hpp"
#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/record/recording.hpp"
#include "tests/simulation/simtest/record/touch_errors.hpp"

namespace lockstep::simtest {

class ClaimCheck : public VirtualObserver {
public:
    ClaimCheck(VirtualMachine& vm, Recording& recording)
        : vm_(vm),
          recording_(recording),
          motors_(motors_of(vm.machine())),
          by_touch_(Kinematics(vm.machine())
                        .motors_of_axes(axes_homed_by_touch(AxisSet::first(vm.machine().axes.size()), vm.machine()))),
          touch_errors_(vm.machine()),
          pulses_(recording.motors.size(), 0),
          power_up_(recording.motors.size(), Tick{std::numeric_limits<std::int64_t>::min()}),
          has_device_(recording.motors.size(), true),
          unnoticed_(recording.motors.size()),
          made_up_(recording.motors.size()),
          encoder_(recording.motors.size()),
          moved_(recording.motors.size()),
          zero_(recording.motors.size()),
          is_zero_new_(recording.motors.size()) {}

    /// Pulses of a device that was replaced meanwhile can be reported late.
    void on_step(MotorIndex axis, StepEdge step) override {
        if (step.tick >= power_up_[axis]) { pulses_[axis] += step.direction; }
        if (made_up_[axis]) { ++*made_up_[axis]; }
    }
    void on_axis(MotorIndex axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override;
    /// Motors that are moved by axes that home by touch.
    const MotorSet& by_touch() const { return by_touch_; }
    /// By how many steps the slide of a homed motor may be off. The switch closes within a step of the reported
    /// position, and whole steps are off by at most half a step. A motor that moves several axes adds up what the
    /// switches of these axes are off.
    double homed_within(MotorIndex motor) const {
        return (by_touch_.contains(motor) ? 4 : 2) + touch_errors_.steps(motor);
    }

private:
    bool has_yet_to_notice(std::size_t axis);
    void note_zero(std::size_t motor, const AxisOutputs& out);
    void object(std::size_t axis, Tick now, const std::string& what);

    VirtualMachine& vm_;
    Recording& recording_;
    std::vector<MotorConfig> motors_;
    MotorSet by_touch_;
    TouchErrors touch_errors_;
    std::vector<std::int64_t> pulses_;  // since the device's power-up
    std::vector<Tick> power_up_;        // in its own time
    std::vector<bool> has_device_;      // the device works, and the axis uses it
    std::vector<std::optional<Slot>>
        unnoticed_;  // the states of an axis since it lost its device; none when it has noticed
    std::vector<std::optional<std::size_t>> made_up_;  // steps that a device made at once when it was no longer stopped
    std::vector<std::int64_t> encoder_;
    std::vector<Tick> moved_;        // when the slide had last moved
    std::vector<double> zero_;       // steps from a motor's zero to the slide's, after a homing in place
    std::vector<bool> is_zero_new_;  // it was homed in place, and has not reported its place since
};

}  // namespace lockstep::simtest
