// The machine's values that outlive programs: which program may use them, and when one changes them.
//
// A program is read with the values of a revision. It is refused with another, because its places would be wrong. The
// values that it leaves become the machine's when it has reached its end: a program that was stopped leaves none.
#pragma once

#include <cstdint>
#include <deque>
#include <expected>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/coordinator/state/coordinator_io.hpp"
#include "core/gcode/kept_values.hpp"

namespace lockstep {

/// Why a program or an edit of the values is refused.
struct ValuesRefusal {
    enum class Why : std::uint8_t {
        Changed,        // since it was read, at revision `read`; they are at `now`
        JobInProgress,  // which depends on these values
    };
    Why why;
    std::uint64_t read = 0;
    std::uint64_t now = 0;
};
/// With the remedy.
std::string text_of(const ValuesRefusal& refusal);

class ValueKeeper {
public:
    ValueKeeper(std::uint64_t revision, gcode::KeptValues values) : revision_(revision), values_(std::move(values)) {}

    std::uint64_t revision() const { return revision_; }
    const gcode::KeptValues& values() const { return values_; }

    /// Increases whenever the values or their revision change; 0: they are as they were loaded.
    std::uint64_t changes() const { return changes_; }

    struct Circumstances {
        bool owns_machine = true;  // else the owner decides, and this coordinator may have to continue the program
        bool has_job = false;      // in motion, held, or inherited by a takeover
    };
    /// A program has arrived, or its first part.
    std::expected<void, ValuesRefusal> accept(std::uint64_t program, const gcode::ProgramValues& values,
                                              Circumstances now);
    /// The last part of a program has arrived: the values that it leaves.
    void note_left(std::uint64_t program, const gcode::KeptValues& after);
    void take(const JobEvent& event);
    /// The owner's values, while another coordinator owns the machine.
    void follow(std::uint64_t revision, gcode::KeptValues values);
    /// Removes the programs that were read with another revision. Call before a command can name one.
    std::vector<std::uint64_t> take_outdated();

private:
    struct Arrived {
        std::uint64_t program = 0;
        std::uint64_t revision = 0;  // that it was read with
        std::optional<gcode::KeptValues> after;
    };
    static constexpr std::size_t kMostArrived = 4;  // as many as there are programs in the ProgramStore

    std::expected<void, ValuesRefusal> edit(const gcode::ProgramValues& values, Circumstances now);
    void change(const gcode::KeptValues& values);
    std::optional<gcode::KeptValues> after(std::uint64_t program) const;

    std::uint64_t revision_;
    gcode::KeptValues values_;
    std::uint64_t changes_ = 0;
    std::deque<Arrived> arrived_;     // the newest last
    std::optional<Arrived> running_;  // of the job in progress
};

}  // namespace lockstep
