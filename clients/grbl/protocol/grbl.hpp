// One connection of a sender that speaks grbl 1.1's protocol, as a state machine: bytes and the machine's state in,
// bytes and requests out. It does no I/O and reads no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "clients/grbl/protocol/gcode_lines.hpp"
#include "clients/grbl/protocol/received_bytes.hpp"
#include "clients/grbl/protocol/request.hpp"
#include "clients/grbl/protocol/settings.hpp"
#include "clients/grbl/protocol/status_report.hpp"

namespace lockstep::grbl {

class Grbl {
public:
    /// `version`: of Lockstep, for $I.
    Grbl(const MachineConfig& machine, std::string version);

    /// The sender has connected: it is greeted.
    void greet();
    void receive(std::string_view bytes);
    /// The machine as it is now.
    void see(const MachineView& view);
    /// The machine as it is when it is next brought up, with the settings that are kept until then.
    void see_next(const MachineConfig& next) { next_machine_ = next; }
    /// A request has ended; one that was given up meanwhile is ignored.
    void answer(std::uint64_t number, const Answer& answer);
    /// The jog that was answered before is over.
    void end_jog();
    /// The sender has gone: its lines that were not accepted are dropped. When the machine rests behind the others,
    /// spindle and coolant are switched off.
    void leave();
    bool is_to_switch_off() const { return is_to_switch_off_; }
    /// The sender before has left spindle or coolant on: they are switched off when the machine rests.
    void switch_off_at_rest() { is_to_switch_off_ = true; }
    /// Lines that were accepted will not be run: an alarm.
    void abort(const std::string& why);

    std::string take_output() { return std::exchange(output_, {}); }
    std::vector<Request> take_requests() { return std::exchange(requests_, {}); }

private:
    void do_real_time(unsigned char byte);
    void soft_reset();
    void forget_lines();
    void hold();
    void stop();
    void turn(const Overrides& overrides);

    void advance();
    void do_line(const ReceivedLine& line);
    void do_system(std::string_view text);
    void do_gcode(const ReceivedLine& line);
    void do_effect(LineEffect&& effect, bool is_check);
    void refuse_gcode(const Refused& refused);
    bool is_settled() const;
    std::vector<double> place_mm() const;
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
    std::string output_;
    std::vector<Request> requests_;
    std::uint64_t number_ = 0;                // of the last request
    std::optional<std::uint64_t> waits_for_;  // the answer to a line depends on it
    bool waits_for_line_ = false;             // that is to be run
    std::string before_ok_;                   // what comes before the ok then
    bool has_jog_ = false;
    bool is_to_switch_off_ = false;          // spindle and coolant, when the machine rests
    std::optional<ReceivedLine> next_jog_;   // waits for the end of the one before
    std::optional<ReceivedLine> next_line_;  // waits until the machine has run those before it
    std::vector<double> planned_mm_;         // where the accepted lines lead, while there are any, and in check mode
};

}  // namespace lockstep::grbl
