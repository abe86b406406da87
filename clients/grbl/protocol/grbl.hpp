// One connection of a sender that speaks the protocol of grbl 1.1, as a state machine. It gets bytes and the machine's
// state, and returns bytes and requests. It does no I/O and reads no clock.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "clients/grbl/protocol/connection.hpp"
#include "clients/grbl/protocol/gcode_run.hpp"
#include "clients/grbl/protocol/received_bytes.hpp"
#include "clients/grbl/protocol/request.hpp"
#include "clients/grbl/protocol/status_report.hpp"
#include "clients/grbl/protocol/system_lines.hpp"

namespace lockstep::grbl {

inline constexpr const char* kGreeting = "Grbl 1.1h ['$' for help]";

class Grbl {
public:
    /// `version`: Lockstep's version, for $I.
    Grbl(const MachineSetup& machine, std::string version);
    Grbl(const Grbl&) = delete;  // its parts refer to it
    Grbl& operator=(const Grbl&) = delete;

    /// Greets a sender that has connected, and begins.
    void greet();
    /// Begins with a sender that was greeted when it connected.
    void begin();
    void receive(std::string_view bytes);
    /// Sets the current state of the machine.
    void see(const MachineView& view);
    /// Sets the configuration that the machine will have when it is next brought up, with the kept settings.
    void see_next(const MachineSetup& next) { system_.see_next(next); }
    /// Takes the answer to a request. Ignores the answer to a request that was given up.
    void answer(std::uint64_t number, const Answer& answer);
    /// The jog that was begun is over.
    void end_jog();
    /// Call when the sender has gone. Drops lines that were not accepted. Spindle and coolant are switched off when the
    /// machine rests after the accepted ones.
    void leave();
    bool is_to_switch_off() const { return gcode_.is_to_switch_off(); }
    /// Call if the previous sender left spindle or coolant on. They are switched off when the machine rests.
    void switch_off_at_rest() { gcode_.switch_off_at_rest(); }
    /// Raises an alarm, because accepted lines will not be run.
    void abort(const std::string& why);

    std::string take_output() { return shared_.output.take(); }
    std::vector<Request> take_requests() { return shared_.requests.take(); }

private:
    void do_real_time(unsigned char byte);
    void soft_reset();
    void forget_lines();
    void hold();
    void resume();
    void say_pause();
    void turn(const Overrides& overrides);

    void advance();
    void do_line(const ReceivedLine& line);
    void jog(std::string_view text);
    void toggle_check();

    Connection shared_;
    GcodeRun gcode_;
    SystemLines system_;
    ReceivedBytes bytes_;
    StatusReport report_;
    std::optional<ReceivedLine> next_jog_;  // waits for the end of the previous jog
};

}  // namespace lockstep::grbl
