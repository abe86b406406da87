// The answer to '?': the machine's state, where it stands, and more as $10 asks for.
#pragma once

#include <string>

#include "clients/grbl/protocol/machine_view.hpp"

namespace lockstep::grbl {

enum class State { Idle, Run, Hold, HoldEnding, Jog, Alarm, Check, Home, Sleep };

/// What the sender's own connection adds to the machine's state.
struct Modes {
    bool is_checking = false;  // $C
    bool is_asleep = false;    // $SLP
    bool is_unlocked = false;  // $X: an unhomed machine is no alarm
    bool is_aborted = false;   // lines were lost: an alarm until a person has seen it
};

State state_of(const MachineView& view, const Modes& modes);

struct ReportOptions {
    int mask = 1;         // $10: bit 0 machine positions, else the work's; bit 1 the buffers
    bool inches = false;  // $13
};

class StatusReport {
public:
    /// `offset_mm`: of the work's zero, by axis. `room`: bytes of lines that still fit.
    std::string text(const MachineView& view, State state, const std::vector<double>& offset_mm, std::size_t room,
                     const ReportOptions& options);
    /// The next one tells everything.
    void restart() { offsets_due_ = overrides_due_ = 0; }

private:
    int offsets_due_ = 0;  // reports until then
    int overrides_due_ = 0;
    std::vector<double> offset_mm_;
    Overrides overrides_;
    std::string accessories_;
};

/// "1.000,-2.500": of each axis, three digits after the point, four where inches.
std::string places_text(const std::vector<double>& mm, bool inches);

}  // namespace lockstep::grbl
