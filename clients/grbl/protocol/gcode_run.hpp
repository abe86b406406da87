// A sender's lines of G-code: each is read at the place where the earlier ones end, and passed to the machine.
#pragma once

#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "clients/grbl/protocol/connection.hpp"
#include "clients/grbl/protocol/received_bytes.hpp"
#include "clients/grbl/protocol/refused_body.hpp"

namespace lockstep::grbl {

class GcodeRun {
public:
    explicit GcodeRun(Connection& connection) : shared_(connection) {}

    void do_line(const ReceivedLine& line);
    /// A line waits until the machine has run the earlier ones, or rests.
    bool must_wait() const { return next_ && (shared_.view.lines > 0 || !shared_.is_settled()); }
    /// Returns the line that has waited, once.
    std::optional<ReceivedLine> take_next() { return std::exchange(next_, std::nullopt); }
    /// Takes the end of the last line's probing move.
    void take_touch(const Answer& answer);
    /// The next lines are only checked, from the machine's place on.
    void begin_check() { planned_mm_.clear(); }
    /// Forgets all lines. Spindle and coolant are switched off when the machine rests after the accepted ones.
    void forget();

    /// The offsets and tools with which the next line begins. A check stores none in the machine.
    const gcode::KeptValues& values() const { return checked_values_ ? *checked_values_ : shared_.view.values; }

    bool is_to_switch_off() const { return is_to_switch_off_; }
    void switch_off_at_rest() { is_to_switch_off_ = true; }
    /// Requests what is_to_switch_off(), once the machine rests.
    void switch_off();

private:
    std::vector<double> place_mm() const;
    void do_effect(LineEffect&& effect, bool is_check);
    void pass_to_machine(LineEffect&& effect, std::int32_t number, const std::string& before_ok);
    void refuse(const Refused& refused);

    Connection& shared_;
    RefusedBody refused_body_;
    std::optional<ReceivedLine> next_;
    std::int32_t line_ = 0;           // of the last line, counted from M2, M30 or a reset
    std::vector<double> planned_mm_;  // end of the accepted lines, while there are any or in check mode
    std::optional<gcode::KeptValues> checked_values_;  // behind the lines of a check
    bool is_to_switch_off_ = false;                    // spindle and coolant, once the machine rests
};

}  // namespace lockstep::grbl
