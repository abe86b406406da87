// When the zero of a motor moves, by its positions. Machine coordinates are the device's count minus the zero. So where
// the zero moves at rest, the positions jump against it.
//
// | why the zero moves | what two positions show, one after the other |
// |---|---|
// | homing by switches, homing by touch at its end, a process that does not know its place | one of them is not homed |
// | homing by touch assumes a place | both are not homed; a jump at rest |
// | homing in place | both are homed; a jump at rest, to the motor's place at the park position |
// | lost steps are made up | a following error at rest, and then another one |
//
// A kept position, a takeover, a hold, a jog and a touch of a probe leave the zero where it is.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "core/machine.hpp"
#include "services/record/reading/positions/recorded_position.hpp"

namespace lockstep::analysis {

/// The zero may have moved between two positions.
struct ZeroMove {
    enum class Why : std::uint8_t {
        NotHomed,      // it may be anywhere
        OtherProcess,  // whose positions are homed; the process before may have moved it after its last position
        HomedInPlace,  // it moved by `change`
        LostSteps,     // if at all, it moved by `change`, unless the encoder moved in between
    };
    Why why = Why::NotHomed;
    std::int64_t change = 0;  // of the zero, in steps

    bool operator==(const ZeroMove&) const = default;
};

class MotorZero {
public:
    /// Until the machine is known, a jump at rest between two positions in sequence may be a homing in place or by
    /// touch.
    void set_machine(const MachineConfig& machine, const std::string& motor);
    /// nullopt if the zero did not move. `position` must be the later one. Positions in between may be missing.
    std::optional<ZeroMove> move_between(const RecordedPosition& before, const RecordedPosition& position) const;
    /// Whether `position` may count from another zero than `before`.
    bool differs_between(const RecordedPosition& before, const RecordedPosition& position) const;

private:
    struct Homing {
        bool assumes_places = false;              // some axes home by touch
        std::optional<std::int64_t> place_steps;  // where the motor stands by definition: it homes in place
    };
    bool may_assume(const RecordedPosition& before, const RecordedPosition& position) const;
    bool may_home_in_place(const RecordedPosition& before, const RecordedPosition& position) const;

    std::optional<Homing> homing_;
};

}  // namespace lockstep::analysis
