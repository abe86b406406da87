// The spindle, the coolant and the outputs as the recorded events have left them. Where events are missing, they are
// not known.
#pragma once

#include "core/program_devices.hpp"

namespace lockstep::verification {

class KnownDevices {
public:
    const ProgramDevices& state() const { return state_; }
    bool are_known() const { return are_known_; }

    void apply(const ProgramEvent& event) { state_.apply(event); }
    void lose() { are_known_ = false; }
    /// The machine rests, and so many pulses of the newest places were not made.
    void note_pulses(std::uint32_t left) { state_.pulses.left = left; }

private:
    ProgramDevices state_;
    bool are_known_ = true;
};

}  // namespace lockstep::verification
