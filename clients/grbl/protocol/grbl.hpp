// One connection of a sender that speaks the protocol of grbl 1.1, as a state machine. It gets bytes and the machine's
// state, and returns bytes and requests. It does no I/O and reads no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/grbl/protocol/gcode_lines.hpp"
#include "clients/grbl/protocol/received_bytes.hpp"
#include "clients/grbl/protocol/refused_body.hpp"
#include "clients/grbl/protocol/request.hpp"
#include "clients/grbl/protocol/settings.hpp"
#include "clients/grbl/protocol/status_report.hpp"

namespace lockstep::grbl {

inline constexpr const char* kGreeting = "Grbl 1.1h ['$' for help]";

class Grbl {
public:
    /// `version`: Lockstep's version, for $I.
    Grbl(const MachineConfig& machine, std::string version);

    /// Greets a sender that has connected, and begins.
    void greet();
    /// Begins with a sender that was greeted when it connected.
    void begin();
    void receive(std::string_view bytes);
    /// Sets the current state of the machine.
    void see(const MachineView& view);
    /// Sets the configuration that the machine will have when it is next brought up, with the kept settings.
    void see_next(const MachineConfig& next) { next_machine_ = next; }
    /// Takes the answer to a request. Ignores the answer to a request that was given up.
    void answer(std::uint64_t number, const Answer& answer);
    /// The jog that was begun is over.
    void end_jog();
    /// Call when the sender has gone. Drops lines that were not accepted. Spindle and coolant are switched off when the
    /// machine rests after the accepted ones.
    void leave();
    bool is_to_switch_off() const { return is_to_switch_off_; }
    /// Call if the previous sender left spindle or coolant on. They are switched off when the machine rests.
    void switch_off_at_rest() { is_to_switch_off_ = true; }
    /// Raises an alarm, because accepted lines will not be run.
    void abort(const std::string& why);

    std::string take_output() { return std::exchange(output_, {}); }
    std::vector<Request> take_requests() { return std::exchange(requests_, {}); }

private:
    void do_real_time(unsigned char byte);
    void soft_reset();
    void forget_lines();
    void hold();
    void resume();
    void say_pause();
    void stop();
    void turn(const Overrides& overrides);

    void advance();
    void do_line(const ReceivedLine& line);
    void do_system(std::string_view text);
    void do_gcode(const ReceivedLine& line);
    void do_effect(LineEffect&& effect, bool is_check);
    void refuse_gcode(const Refused& refused);
    void take_touch(const Answer& answer);
    std::string probe_text(const ProbeResult& probe) const;
    bool is_settled() const;
    std::vector<double> place_mm() const;
    const gcode::KeptValues& values() const;
    void switch_off();
    void raise_alarm(int number, const std::string& why);
    void do_jog(std::string_view text);
    void do_home(std::string_view axis);
    void unlock();
    void toggle_check();
    void restore(std::string_view what);
    void do_startup_block(std::string_view text);
    void write_setting(std::string_view text);
    void keep_setting(int number, double value);
    void print_settings();
    void print_parameters();
    void print_build();

    void say(const std::string& line) { output_ += line + "\r\n"; }
    void say_message(const std::string& text);
    void ok() { say("ok"); }
    void refuse(Error error, const std::string& text = {});
    Request& ask(Request::Kind kind);
    State state() const;
    bool is_quiet() const;

    MachineConfig machine_;
    MachineConfig next_machine_;
    std::string version_;
    ReceivedBytes bytes_;
    MachineView view_;
    Modes modes_;
    ReportOptions options_;
    StatusReport report_;
    GcodeLines lines_;
    RefusedBody refused_body_;
    std::string output_;
    std::vector<Request> requests_;
    std::uint64_t number_ = 0;                // number of the last request
    std::optional<std::uint64_t> waits_for_;  // request that must be answered before its line is
    bool waits_for_line_ = false;             // that request is to run a line
    std::optional<SessionLine> asked_line_;   // of that request
    std::int32_t program_line_ = 0;           // of the last line, counted from M2, M30 or a reset
    std::string before_ok_;                   // sent before the ok of that line
    bool has_jog_ = false;
    bool is_to_switch_off_ = false;          // spindle and coolant, once the machine rests
    std::optional<ReceivedLine> next_jog_;   // waits for the end of the previous jog
    std::optional<ReceivedLine> next_line_;  // waits until the machine has run the earlier lines
    std::vector<double> planned_mm_;         // end of the accepted lines, while there are any or in check mode
    std::optional<gcode::KeptValues> checked_values_;  // behind the lines of a check
};

}  // namespace lockstep::grbl
