// Turns a sender's requests into commands to the machine, and the machine's state into the sender's view. Requests
// block only to take the lease and to store offsets.
#pragma once

#include <optional>
#include <vector>

#include "clients/grbl/lines/line_runner.hpp"
#include "clients/grbl/protocol/grbl.hpp"
#include "clients/grbl/settings_store.hpp"
#include "clients/session/control/jog_link.hpp"
#include "clients/session/session.hpp"

namespace lockstep::grbl {

/// Sends the messages of programs through a session.
class SessionPort : public MachinePort {
public:
    explicit SessionPort(Session& session) : session_(session) {}
    ProgramSender& open(const ProgramHead& head) override { return session_.upload().open(head); }
    void close() override { session_.upload().close(); }
    bool is_overdue() override { return is_upload_overdue(session_); }
    CommandStep follow(CommandTracker& tracker) override { return session_.follow(tracker); }

private:
    Session& session_;
};

class MachineLink {
public:
    /// `takes_over`: the sender's work takes the machine over even from another writer.
    MachineLink(Session& session, SettingsStore& settings, bool takes_over)
        : session_(session),
          settings_(settings),
          takes_over_(takes_over),
          jog_(session),
          port_(session),
          lines_(session.config(), port_) {}

    void carry_out(Request&& request, Grbl& grbl);
    /// Receives messages for `time`, renews the jog, and tells `grbl` the changes.
    void pass(std::chrono::nanoseconds time, Grbl& grbl);
    /// Call when the sender has gone. Releases the jog, lets the machine finish the lines that it runs, and drops
    /// answers.
    void leave();
    /// Whether no line, no jog and no command is in progress.
    bool is_idle() const { return open_.empty() && !has_jog_ && lines_.is_idle(); }
    /// Whether the machine waits for a person or is not received, so that accepted lines may never end.
    bool is_stuck() const;
    /// Call after leave(). Sends the machine the rest of the lines that it runs, for at most 3 s, and gives the lease
    /// back.
    void release();

private:
    /// A command that was sent and not answered, or a job that has not ended.
    struct Open {
        CommandTracker tracker;
        std::uint64_t number = 0;  // of the request; 0 if nobody waits for it
        std::uint64_t job = 0;     // of an accepted request that is answered when this job ends
    };
    /// Takes the lease. If another writer has the machine, answers the request with the refusal and returns false.
    bool claim(const Request& request, Grbl& grbl);
    void pass_lease(Grbl& grbl);
    void send(const Command& command, std::uint64_t number) { open_.push_back({CommandTracker(command), number}); }
    /// Returns true if the command or job is over.
    bool follow(Open& open, Grbl& grbl);
    bool has_ended(const Open& open, Grbl& grbl) const;
    void follow_jog(Grbl& grbl);
    void pass_lines(Grbl& grbl);
    void set_values(const Request& request, Grbl& grbl);
    /// Returns false if the change was refused; the request is then answered with the refusal.
    bool change_settings(const Request& request, Grbl& grbl);
    bool rests() const;
    MachineView view();

    Session& session_;
    SettingsStore& settings_;
    bool takes_over_;
    JogLink jog_;
    SessionPort port_;
    LineRunner lines_;
    std::vector<Open> open_;
    std::optional<std::uint64_t> new_jog_;  // its request, not answered yet
    bool has_jog_ = false;
    gcode::KeptValues values_;
};

}  // namespace lockstep::grbl
