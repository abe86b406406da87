// A sender's hold of its lines: the machine comes to rest on its path, or does not begin, until the sender resumes.
#pragma once

#include <optional>

#include "clients/grbl/lines/machine_port.hpp"

namespace lockstep::grbl {

class LineHold {
public:
    explicit LineHold(MachinePort& port) : port_(port) {}

    /// `has_lines`: the hold is for lines, and lasts until the machine reports it. Otherwise it is commanded at once.
    void hold(bool has_lines) {
        is_wanted_ = has_lines;
        if (!has_lines) { begin(port_, hold_, CommandKind::Hold); }
    }
    /// `has_begun`: the machine has begun the lines, or there are none.
    void resume(bool has_begun) {
        is_wanted_ = false;
        if (has_begun) { begin(port_, resume_, CommandKind::Resume); }
    }
    /// Call in each loop. `phase`: the machine's, if it runs these lines.
    void pass(bool has_lines, std::optional<MachinePhase> phase) {
        const bool is_held = phase == MachinePhase::Holding || phase == MachinePhase::Paused;
        if (!has_lines || is_held) { is_wanted_ = false; }
        if (is_wanted_ && phase == MachinePhase::Running && !hold_) { begin(port_, hold_, CommandKind::Hold); }
        follow(port_, hold_);
        follow(port_, resume_);
    }
    void drop() {
        is_wanted_ = false;
        hold_.reset();
        resume_.reset();
    }
    /// The sender wants a hold, and the machine does not report it yet.
    bool is_wanted() const { return is_wanted_; }

private:
    MachinePort& port_;
    bool is_wanted_ = false;
    std::optional<CommandTracker> hold_;
    std::optional<CommandTracker> resume_;
};

}  // namespace lockstep::grbl
