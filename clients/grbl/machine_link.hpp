// A sender's requests as commands to the machine, and the machine's state for the sender. It waits for nothing except
// where offsets are stored.
#pragma once

#include <optional>
#include <vector>

#include "clients/grbl/line_sink.hpp"
#include "clients/grbl/protocol/grbl.hpp"
#include "clients/session/control/jog_link.hpp"
#include "clients/session/session.hpp"

namespace lockstep::grbl {

class MachineLink {
public:
    MachineLink(Session& session, LineSink& sink) : session_(session), jog_(session), sink_(sink) {}

    void carry_out(Request&& request, Grbl& grbl);
    /// Receives messages for so long, renews the jog, and tells the connection what has changed.
    void pass(std::chrono::nanoseconds time, Grbl& grbl);
    /// Nobody listens any more: the jog is released, and answers are of no interest.
    void release();

private:
    /// A command that was sent and not answered, or a job that has not ended.
    struct Open {
        Command command;
        std::uint64_t number = 0;  // of the request; 0: nobody waits for it
        std::chrono::nanoseconds sent{};
        std::uint64_t job = 0;  // once it is accepted, where the request is answered at its end
    };
    void send(Command command, std::uint64_t number);
    /// True: it is over.
    bool follow(Open& open, Grbl& grbl);
    bool has_ended(const Open& open, Grbl& grbl) const;
    void follow_jog(Grbl& grbl);
    void set_values(const Request& request, Grbl& grbl);
    bool rests() const;
    MachineView view();

    Session& session_;
    JogLink jog_;
    LineSink& sink_;
    std::vector<Open> open_;
    std::optional<std::uint64_t> new_jog_;  // its request
    bool has_jog_ = false;
    gcode::KeptValues values_;
};

}  // namespace lockstep::grbl
