// Checks that each axis reports the truth: compares every one of its states with its pulses and its slide.
#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "core/protocol/rules.hpp"
#include "services/virtual/virtual_machine.hpp"
#include "tests/simulation/simtest/record/recording.hpp"

namespace lockstep::simtest {

class ClaimCheck : public VirtualObserver {
public:
    ClaimCheck(VirtualMachine& vm, Recording& recording)
        : vm_(vm),
          recording_(recording),
          pulses_(recording.axes.size(), 0),
          power_up_(recording.axes.size(), Tick{std::numeric_limits<std::int64_t>::min()}),
          has_device_(recording.axes.size(), true),
          unnoticed_(recording.axes.size()),
          encoder_(recording.axes.size()),
          moved_(recording.axes.size()) {}

    /// Pulses of a device that was replaced meanwhile can be reported late.
    void on_step(std::size_t axis, StepEdge step) override {
        if (step.tick >= power_up_[axis]) { pulses_[axis] += step.direction; }
    }
    void on_axis(std::size_t axis, Tick now, const AxisOutputs& out, AxisNode& node) override;
    void on_fault(Tick now, const VirtualFault& fault, bool begins) override;

private:
    bool has_yet_to_notice(std::size_t axis);
    void object(std::size_t axis, Tick now, const std::string& what);

    VirtualMachine& vm_;
    Recording& recording_;
    std::vector<std::int64_t> pulses_;  // since the device's power-up
    std::vector<Tick> power_up_;        // in its own time
    std::vector<bool> has_device_;      // the device works, and the axis uses it
    std::vector<std::optional<Slot>>
        unnoticed_;  // the states of an axis since it lost its device; none when it has noticed
    std::vector<std::int64_t> encoder_;
    std::vector<Tick> moved_;  // when the slide had last moved
};

}  // namespace lockstep::simtest
