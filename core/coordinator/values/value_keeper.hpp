// The machine's values that outlive programs: which program may use them, and when one changes them.
//
// A program is read with the values of one revision. It is refused at any other, because its places would be wrong. The
// values that it leaves become the machine's when it has reached its end. A program that was stopped leaves none. In
// a pause a person may change values. The rest of the program keeps its places, because they are machine coordinates.
// At its end only the values that the program itself changed become the machine's.
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
        Changed,        // the values changed: they were read at revision `read` and are at `now`
        JobInProgress,  // a job is in progress and depends on these values
    };
    Why why;
    std::uint64_t read = 0;
    std::uint64_t now = 0;
};
/// The reason with the remedy, for a person.
std::string text_of(const ValuesRefusal& refusal);

class ValueKeeper {
public:
    ValueKeeper(std::uint64_t revision, gcode::KeptValues values) : revision_(revision), values_(std::move(values)) {}

    std::uint64_t revision() const { return revision_; }
    const gcode::KeptValues& values() const { return values_; }

    /// Increases whenever the values or their revision change; 0: they have not changed since they were loaded.
    std::uint64_t changes() const { return changes_; }

    struct Circumstances {
        bool owns_machine = true;  // otherwise the owner decides, and this coordinator may have to continue the program
        bool has_job = false;      // a job is in motion, held, or inherited by a takeover
        bool is_paused = false;    // that job waits for a person, and nothing moves
    };
    /// Call it when a program or its first part has arrived.
    std::expected<void, ValuesRefusal> accept(std::uint64_t program, const gcode::ProgramValues& values,
                                              Circumstances now);
    /// Call it when the last part of a program has arrived. `after`: the values at the program's end.
    void note_left(std::uint64_t program, const gcode::KeptValues& after);
    void take(const JobEvent& event);
    /// Takes the owner's values while another coordinator owns the machine.
    void follow(std::uint64_t revision, gcode::KeptValues values);
    /// Removes the programs that were read with another revision, and returns them. Call it before a command can name
    /// one.
    std::vector<std::uint64_t> take_outdated();

private:
    struct Arrived {
        std::uint64_t program = 0;
        std::uint64_t revision = 0;  // with which it was read
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
    gcode::KeptValues began_;         // the values with which it began
};

}  // namespace lockstep
