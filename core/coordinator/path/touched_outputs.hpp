// How many changes of outputs the events of one tick cause, at the device at which they cause the most.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "core/machine.hpp"
#include "core/outputs/output_levels.hpp"
#include "core/program.hpp"

namespace lockstep {

class TouchedOutputs {
public:
    explicit TouchedOutputs(std::span<const OutputConfig> outputs) {
        for (const OutputConfig& output : outputs) {
            const auto of_motor = [&](const Motor& motor) { return motor.outputs[0].config.motor == output.motor; };
            auto motor = std::ranges::find_if(motors_, of_motor);
            if (motor == motors_.end()) { motor = motors_.insert(motor, Motor{}); }
            motor->outputs.push_back({.config = output, .is_touched = false});
        }
    }

    /// There are no outputs.
    bool none() const { return motors_.empty(); }
    void clear() {
        for (Motor& motor : motors_) {
            for (Output& output : motor.outputs) { output.is_touched = false; }
        }
    }
    void add(const ProgramEvent& event) {
        for (Motor& motor : motors_) {
            for (Output& output : motor.outputs) {
                output.is_touched = output.is_touched || is_switched_by(output.config, event);
            }
        }
    }
    /// Digital outputs of a device change together.
    std::size_t changes() const {
        std::size_t most = 0;
        for (const Motor& motor : motors_) { most = std::max(most, motor.changes()); }
        return most;
    }
    /// The most changes in a body or tail that are not at events: an epoch's first frame states all levels, an output
    /// that follows the speed may change its slope at the begin, and is off at rest. Pulses begin again with an epoch.
    std::size_t besides() const {
        std::size_t most = 0;
        for (const Motor& motor : motors_) { most = std::max(most, motor.besides()); }
        return most;
    }

    /// A frame's body and tail should have room for so many changes: those besides events, and all outputs of a device
    /// twice, because from rest a path cannot begin so slowly that events are ever so far apart.
    static std::size_t least_room(std::span<const OutputConfig> outputs) {
        TouchedOutputs all(outputs);
        std::size_t most = 0;
        for (Motor& motor : all.motors_) {
            for (Output& output : motor.outputs) { output.is_touched = true; }
            most = std::max(most, motor.besides() + 2 * motor.changes());
        }
        return most;
    }

private:
    struct Output {
        OutputConfig config;
        bool is_touched = false;
    };
    struct Motor {
        std::vector<Output> outputs;

        std::size_t changes() const {
            std::size_t others = 0;
            bool has_level = false;
            for (const Output& output : outputs) {
                if (!output.is_touched) { continue; }
                others += output.config.has_level() ? 0 : 1;
                has_level = has_level || output.config.has_level();
            }
            return others + (has_level ? 1 : 0);
        }
        std::size_t besides() const {
            std::size_t count = 1;
            for (const Output& output : outputs) {
                count += output.config.is_analog() ? 2 : output.config.makes_pulses() ? 1 : 0;
            }
            return count;
        }
    };

    std::vector<Motor> motors_;
};

}  // namespace lockstep
