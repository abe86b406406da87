// The geometry of a stream of moves: lines are joined, arcs are cut, and the machine comes to rest on whole steps.
//
// Pieces are final once the next one is known, because the end of the last piece may still move to a whole step.
#pragma once

#include <span>

#include "core/path/geometry/arc_cutter.hpp"
#include "core/path/geometry/chord_joiner.hpp"
#include "core/path/geometry/path_trail.hpp"

namespace lockstep {

class PathGeometry {
public:
    explicit PathGeometry(const PathSetup& setup) : setup_(setup), joiner_(setup) {}

    /// Begins a stream. The axes rest at `at`.
    void begin(std::span<const Position> at);
    /// Sets the programmed place at the begin, which is less than a step from the place of rest. Arcs need it.
    void begin_program_at(const PlaceVector& steps) { programmed_ = steps; }

    /// The moves are as in PathPlanner. `to` is in steps. An arc that is not cut to its end is cut before the next
    /// move.
    void line(const PlaceVector& to, const MoveSettings& settings, std::uint32_t block);
    void rest(Ticks ticks, std::uint32_t block);
    void finish();
    /// Begins an arc. Call cut_on() while there are more pieces of it.
    void begin_arc(const ArcShape& shape, const PlaceVector& to, const MoveSettings& settings, std::uint32_t block);
    bool has_more() const { return !arc_.is_done(); }
    /// Adds the next quarter turn of the arc, or its rest.
    void cut_on();

    const PathTrail& trail() const { return trail_; }
    /// The pieces before this one are final.
    std::size_t ready() const { return ready_; }
    void drop_before(std::size_t piece) { trail_.drop_before(piece); }
    /// The spot of a place; nullopt if its piece has not been added.
    std::optional<PathSpot> spot_of(const PathPlace& place) const;

    /// As in ArcCutter. 0 if the turns of the arc do not repeat, and if a motor may follow an axis of the arc's plane
    /// and another one together: then its steps do not repeat.
    int turns_that_repeat() const { return has_more() && !setup_.has_map() && arc_.repeats() ? arc_.turns_left() : 0; }
    const ArcShape& arc() const { return arc_.shape(); }
    void skip_turns(int turns) { arc_.skip(setup_, turns); }

    static constexpr Ticks kLeastRest{64};

private:
    void cut_to_end();
    void end_arc();
    void come_to_rest();
    bool move_end(const PlaceVector& end);
    void all_but_last_are_ready();

    PathSetup setup_;
    ChordJoiner joiner_;
    ArcCutter arc_;
    MoveSettings arc_settings_;
    PathTrail trail_;
    PlaceVector at_;          // where the last move ends, in steps; whole ones if the machine rests there
    PlaceVector programmed_;  // where it ends in the program, up to half a step beyond the travel
    std::size_t ready_ = 0;
};

}  // namespace lockstep
