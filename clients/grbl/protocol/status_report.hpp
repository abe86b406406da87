// The answer to '?': the machine's state and position, and further fields as $10 selects.
#pragma once

#include <string>

#include "clients/grbl/protocol/machine_view.hpp"

namespace lockstep::grbl {

enum class State { Idle, Run, Hold, HoldEnding, Jog, Alarm, Check, Home, Sleep };

/// The part of the state that belongs to the sender's connection.
struct Modes {
    bool is_checking = false;  // $C
    bool is_asleep = false;    // $SLP
    bool is_unlocked = false;  // $X: an unhomed machine does not count as an alarm
    bool is_aborted = false;   // lines were lost; an alarm until $X or $H
};

State state_of(const MachineView& view, const Modes& modes);

struct ReportOptions {
    int mask = 1;         // $10: bit 0 machine positions, else work positions; bit 1 buffers
    bool inches = false;  // $13
};

class StatusReport {
public:
    /// `offset_mm`: the offset of the work's zero, by axis. `room`: bytes of lines that still fit.
    std::string text(const MachineView& view, State state, const std::vector<double>& offset_mm, std::size_t room,
                     const ReportOptions& options);
    /// The next reports contain offsets and overrides again.
    void restart() { offsets_due_ = overrides_due_ = 0; }

private:
    int offsets_due_ = 0;  // number of reports until the next with WCO
    int overrides_due_ = 0;
    std::vector<double> offset_mm_;
    Overrides overrides_;
    std::string accessories_;
};

/// "1.000,-2.500": a number for each axis, with three digits after the point, or four in inches.
std::string places_text(const std::vector<double>& mm, bool inches);
/// The place of a touch in machine coordinates, and whether there was one: "1.000,2.000,-3.500:1".
std::string probe_text(const ProbeResult& probe, bool inches);

}  // namespace lockstep::grbl
