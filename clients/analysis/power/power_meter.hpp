// Measures the power that an output really had along the path: only by the steps and the changes of the output on
// record.
//
// The path is followed in chords of a few steps, with the time of each step. Each is divided where the power changed.
// Until the next change has come and shows that none is missing before it, the power is kept apart from the rest.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "clients/analysis/power/power_grid.hpp"
#include "clients/analysis/power/power_track.hpp"
#include "core/units.hpp"

namespace lockstep::analysis {

/// Where the path was when the power changed.
struct PlacedChange {
    Tick at;
    drawing::Point place_mm;
};

class PowerMeter {
public:
    static constexpr std::size_t kChangesKept = 1000;

    /// `step_mm`: the larger one of the plane's axes.
    PowerMeter(PowerTrack track, double step_mm, std::int64_t tick_ns)
        : track_(std::move(track)),
          chord_mm_(kChordSteps * step_mm),
          tick_s_(static_cast<double>(tick_ns) * 1e-9),
          made_(kCellSteps * step_mm),
          pending_(kCellSteps * step_mm, PowerGrid::Keeps::All) {}

    void take(const channel_event_t& message);
    /// The path is there, after rising ticks. All changes until then should have been taken.
    void at(Tick tick, drawing::Point place_mm);
    /// The next place does not join the last one.
    void part();
    /// Call once, at the end.
    void finish();

    const PowerGrid& made() const { return made_; }
    /// The first kChangesKept.
    const std::vector<PlacedChange>& changes() const { return changes_; }

private:
    static constexpr double kChordSteps = 3;
    static constexpr double kCellSteps = 4;
    static constexpr std::size_t kMostKnots = 64;
    static constexpr std::int64_t kRestRatio = 4;
    static constexpr double kShortestRest_s = 0.02;

    struct Place {
        Tick tick;
        drawing::Point mm;
    };
    void end_chord();
    void step(Place to);
    void move(Place to);
    void add(Place from, Place to);
    void add_even(Place from, Place to);
    void apply(const PowerChange& change, drawing::Point place_mm);
    void settle();

    PowerTrack track_;
    double chord_mm_;
    double tick_s_;
    PowerGrid made_;
    PowerGrid pending_;               // since the last change
    std::optional<ValueRamp> power_;  // now; nullopt: not known
    std::vector<Place> knots_;        // of the chord: its begin, and the places after each step
    Place now_;                       // until here the path has been added
    Ticks last_step_;                 // between the last two steps
    std::vector<PlacedChange> changes_;
};

}  // namespace lockstep::analysis
