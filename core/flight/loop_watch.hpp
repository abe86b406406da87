// The notes of a process about its own loop: each stall, and once a second the number and gaps of loops.
#pragma once

#include <algorithm>
#include <optional>

#include "core/flight/flight_event.hpp"
#include "core/machine.hpp"

namespace lockstep {

class LoopWatch {
public:
    explicit LoopWatch(const MachineConfig& machine)
        : noted_(machine.slot_ticks() * std::max(1, machine.timing.stall_slots / 2)),
          second_{static_cast<std::int64_t>(machine.ticks_per_second())} {}

    /// Call it at each loop. Returns for how long the loop did not run if that is worth a note, otherwise 0.
    Ticks loop(Tick now, FlightLog& log) {
        if (!last_) { begin(now, log); }
        const Ticks gap = now - *last_;
        last_ = now;
        longest_ = std::max(longest_, gap);
        ++loops_;
        if (now - second_began_ >= second_) { note_state(now, log); }
        if (gap <= noted_) { return {}; }
        log.add({.tick = now, .kind = FlightKind::Stalled, .lasts = gap});
        return gap;
    }

private:
    void begin(Tick now, FlightLog& log) {
        last_ = second_began_ = now;
        log.add({.tick = now, .kind = FlightKind::Started});
    }
    void note_state(Tick now, FlightLog& log) {
        log.add({.tick = now, .kind = FlightKind::Loops, .count = loops_, .lasts = longest_});
        second_began_ = now;
        loops_ = 0;
        longest_ = {};
    }

    Ticks noted_;
    Ticks second_;
    std::optional<Tick> last_;
    Tick second_began_;
    std::int64_t loops_ = 0;
    Ticks longest_;
};

}  // namespace lockstep
