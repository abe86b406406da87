// A sender's requests as commands to the machine, and the machine's state for the sender. It waits for nothing except
// where offsets are stored.
#pragma once

#include <optional>
#include <vector>

#include "clients/grbl/lines/line_runner.hpp"
#include "clients/grbl/protocol/grbl.hpp"
#include "clients/grbl/sender_lease.hpp"
#include "clients/grbl/settings_store.hpp"
#include "clients/session/control/jog_link.hpp"
#include "clients/session/session.hpp"

namespace lockstep::grbl {

/// A session as the messages of programs.
class SessionPort : public MachinePort {
public:
    explicit SessionPort(Session& session) : session_(session) {}
    ProgramSender& open(const ProgramHead& head) override { return session_.open_stream(head); }
    void close() override { session_.close_stream(); }
    void begin(Command& command) override { session_.begin(command); }
    void repeat(const Command& command) override { session_.repeat(command); }
    const Reply* reply_to(const Command& command) override { return session_.reply_to(command); }

private:
    Session& session_;
};

class MachineLink {
public:
    /// `takes_over`: the sender's work takes the machine from another writer, too.
    MachineLink(Session& session, SettingsStore& settings, bool takes_over)
        : session_(session),
          settings_(settings),
          lease_(session, takes_over),
          jog_(session),
          port_(session),
          lines_(session.config(), port_) {}

    void carry_out(Request&& request, Grbl& grbl);
    /// Receives messages for so long, renews the jog, and tells the connection what has changed.
    void pass(std::chrono::nanoseconds time, Grbl& grbl);
    /// Nobody listens any more: the jog is released, what was accepted is run, and answers are of no interest.
    void leave();
    /// No line, no jog and no command is in progress.
    bool is_idle() const { return open_.empty() && !has_jog_ && lines_.is_idle(); }
    /// The machine waits for a person, or is not there: what was accepted may not end by itself.
    bool is_stuck() const;
    /// Behind leave(): the machine gets what it still lacks of the lines that it runs, and another may command it.
    void release();

private:
    /// A command that was sent and not answered, or a job that has not ended.
    struct Open {
        Command command;
        std::uint64_t number = 0;  // of the request; 0: nobody waits for it
        std::chrono::nanoseconds sent{};
        std::uint64_t job = 0;  // once it is accepted, where the request is answered at its end
    };
    /// False: another writer has the machine, and the request was answered with that.
    bool claim(const Request& request, Grbl& grbl);
    void pass_lease(Grbl& grbl);
    void send(Command command, std::uint64_t number);
    /// True: it is over.
    bool follow(Open& open, Grbl& grbl);
    bool has_ended(const Open& open, Grbl& grbl) const;
    void follow_jog(Grbl& grbl);
    void pass_lines(Grbl& grbl);
    void set_values(const Request& request, Grbl& grbl);
    /// False: it was refused, and answered with that.
    bool change_settings(const Request& request, Grbl& grbl);
    bool rests() const;
    MachineView view();

    Session& session_;
    SettingsStore& settings_;
    SenderLease lease_;
    JogLink jog_;
    SessionPort port_;
    LineRunner lines_;
    std::vector<Open> open_;
    std::optional<std::uint64_t> new_jog_;  // its request
    bool has_jog_ = false;
    gcode::KeptValues values_;
};

}  // namespace lockstep::grbl
