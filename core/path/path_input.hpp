// Takes the moves of a program and adds them to the geometry of a path, as a stream.
#pragma once

#include "core/path/geometry/path_geometry.hpp"

namespace lockstep {

class PathInput {
public:
    /// Shorter moves are left out until they add up to this.
    static constexpr double kLeastMove_mm = ChordJoiner::kLeast_mm;

    /// Sets the programmed place at the begin, which is less than a step from the place of rest. Arcs need it.
    void begin_program_at(const PlaceVector& steps) { geometry_.begin_program_at(steps); }

    /// `block`: the move's number in its program. Numbers ascend. `to` is in steps, also fractional ones. Moves end
    /// within the travel. Programmed places may be up to half a step beyond it; they determine the shape of an arc.
    void line_to_steps(const PlaceVector& to, const MoveSettings& settings, std::uint32_t block) {
        geometry_.line(to, settings, block);
        pass_on();
    }
    /// Begins an arc. How much of it is cut at once depends on the path. The next move cuts what is left of it.
    void begin_arc_to_steps(const ArcShape& shape, const PlaceVector& to, const MoveSettings& settings,
                            std::uint32_t block) {
        geometry_.begin_arc(shape, to, settings, block);
        pass_arc();
    }
    /// The machine rests on whole steps for `ticks`, at least for kLeastRest.
    void rest(Ticks ticks, std::uint32_t block) {
        geometry_.rest(ticks, block);
        pass_on();
    }
    /// Ends the path: the machine comes to rest on whole steps at the end of the last move.
    void finish() {
        geometry_.finish();
        pass_on();
        end();
    }

    /// Stored pieces.
    std::size_t kept() const { return geometry_.trail().end() - geometry_.trail().first(); }

    static constexpr Ticks kLeastRest = PathGeometry::kLeastRest;

protected:
    explicit PathInput(const PathSetup& setup) : geometry_(setup) {}
    PathInput(const PathInput&) = default;
    PathInput& operator=(const PathInput&) = delete;
    ~PathInput() = default;

    PathGeometry geometry_;

private:
    /// Takes the pieces that have become final.
    virtual void pass_on() = 0;
    /// An arc was begun.
    virtual void pass_arc() { pass_on(); }
    /// The last piece was passed on.
    virtual void end() = 0;
};

}  // namespace lockstep
