// What all parts of one connection use: the machine as the sender sees it, the connection's modes, and the lines to the
// sender and requests to the machine.
#pragma once

#include <string>

#include "clients/grbl/protocol/gcode_lines.hpp"
#include "clients/grbl/protocol/machine_view.hpp"
#include "clients/grbl/protocol/open_requests.hpp"
#include "clients/grbl/protocol/sender_output.hpp"
#include "clients/grbl/protocol/status_report.hpp"

namespace lockstep::grbl {

struct Connection {
    explicit Connection(const MachineSetup& the_machine) : machine(the_machine), lines(the_machine) {}

    /// A requested jog counts as Jog before the machine's state shows it.
    State state() const {
        const State now = state_of(view, modes);
        return has_jog && now != State::Alarm ? State::Jog : now;
    }
    bool is_quiet() const {
        const State now = state();
        return (now == State::Idle || now == State::Alarm) && !has_jog;
    }
    /// Whether the position where the next line begins is known, from earlier lines or because the machine rests.
    bool is_settled() const {
        if (view.is_stopping || view.phase == MachinePhase::Stopping) { return false; }
        return view.lines > 0 || view.phase != MachinePhase::Idle || view.is_at_rest();
    }
    /// Until the machine rests, its position is not known.
    void stop() {
        (void)requests.add(Request::Kind::Stop);
        view.is_stopping = true;
        view.lines = 0;
    }
    void raise_alarm(int number, const std::string& why) {
        output.say("ALARM:" + std::to_string(number));
        output.say_message(why);
        modes.is_aborted = true;
    }

    MachineSetup machine;
    MachineView view;
    Modes modes;
    ReportOptions options;
    GcodeLines lines;
    bool has_jog = false;
    SenderOutput output;
    OpenRequests requests;
};

}  // namespace lockstep::grbl
