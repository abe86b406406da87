// The changes of outputs that the runs of an epoch plan, and the pulses at places that their steps make.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "clients/verification/steps/output_check.hpp"
#include "clients/verification/steps/pulse_check.hpp"
#include "core/machine.hpp"
#include "core/protocol/messages.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::verification {

/// A run of an axis.
struct AxisRun {
    std::string axis;
    analysis::Run run;
    bool is_behind_gap = false;  // runs before it are missing
};

class PlannedOutputs {
public:
    /// Called for each run that is as planned and has an output, unless the state of the devices is not known.
    using OnOutputs = std::function<void(const std::string& motor, OutputCheck::Planned planned)>;
    explicit PlannedOutputs(OnOutputs on_outputs) : on_outputs_(std::move(on_outputs)) {}

    /// An epoch begins. `are_known`: the state of the devices is known.
    void begin(const MachineConfig& machine, bool are_known);
    /// A run that is as planned. `frame`: the planned one; null if there is none. `commanded`: its job and its frame.
    /// A run that was cut is not compared: its device made the outputs safe.
    void take(const AxisRun& of, const Frame* frame, MotorIndex motor, const std::function<std::string()>& commanded);
    /// How many pulses of the newest places the motor had not made at the end of the epoch; nullopt: not known.
    const std::optional<std::uint32_t>& left(const std::string& motor) const { return pulses_.at(motor).left(); }

private:
    OnOutputs on_outputs_;
    bool are_known_ = false;
    std::map<std::string, PulseCheck> pulses_;  // of motors whose devices make pulses at places
};

}  // namespace lockstep::verification
