// Checks the clocks of a record against the machine's file: processes that share a clock know machine time exactly,
// others within the limit at which they may run frames together.
#pragma once

#include <optional>
#include <string>

#include "core/machine.hpp"
#include "services/record/reading/run.hpp"
#include "services/record/reading/step_stream.hpp"

namespace lockstep::verification {

class ClockCheck {
public:
    /// The machine is known from its first job on. Messages before that are not checked.
    void set_machine(const MachineConfig& machine) {
        if (!machine_) { machine_ = machine; }
    }
    /// Returns why the times of a message are impossible; nullopt if they are not.
    std::optional<std::string> take(const std::string& axis, const analysis::StepBatch& batch) const;
    std::optional<std::string> take(const std::string& axis, const analysis::Run& run) const;

    /// Of the steps of a frame.
    std::optional<std::string> take_in_frame(const analysis::Run& run, Ticks error) const;

private:
    bool shares_clock(const std::string& name) const;
    /// Twice the limit: the bound may grow while a frame that was armed in time is run.
    Ticks most() const { return machine_->clock_error_limit() * 2; }

    std::optional<MachineConfig> machine_;
};

}  // namespace lockstep::verification
