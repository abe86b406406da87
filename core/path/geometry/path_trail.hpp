// The pieces of geometry of a stream of moves, in order, and the places of these moves on them.
//
// A PathPlace names a move by its block; `along` is the distance along this move in 2^-64 mm. Pieces and places depend
// on the program only, so a place leads to the same spot in every planner that gets the same moves.
#pragma once

#include <algorithm>
#include <optional>

#include "core/path/geometry/quadratic.hpp"
#include "core/path/sliding_vector.hpp"
#include "core/path_place.hpp"
#include "core/reused_queue.hpp"

namespace lockstep {

/// A place on the geometry.
struct PathSpot {
    std::size_t piece = 0;  // its number since the beginning of the stream
    double u = 0;           // mm
    bool operator==(const PathSpot&) const = default;
};

class PathTrail {
public:
    void clear();

    /// Marks the place u of the piece that is added next as `along` mm from the begin of a move. Each piece has a mark
    /// at its begin and one for each move that begins on it. Blocks ascend. All marks of a move must be added before a
    /// place in it is looked up.
    void mark(double u, std::uint32_t block, double along);
    void add(const Quadratic& piece) {
        pieces_.push_back(piece);
        pieces_.back().begins_at_rest = is_at_rest_;
        pieces_.back().piece = end() - 1;
        is_at_rest_ = false;
    }
    /// Adds a rest, as a separate move or at the end of the last move.
    void add_rest(const Quadratic& rest, std::uint32_t block);
    /// The machine rests at the end of the last piece, at whole steps.
    void rest_at_end() {
        pieces_.back().ends_at_rest = true;
        is_at_rest_ = true;
    }
    /// Removes the last piece and its marks.
    void pop_back();
    /// Drops the pieces before this one.
    void drop_before(std::size_t piece);

    /// The stored pieces have the numbers from first() up to end().
    std::size_t first() const { return first_; }
    std::size_t end() const { return first_ + pieces_.size(); }
    const Quadratic& piece(std::size_t number) const { return pieces_[number - first_]; }
    Quadratic& back() { return pieces_.back(); }

    /// The place of a spot on a stored piece.
    PathPlace place_of(const PathSpot& spot) const;
    /// Returns nullopt if the move has not been added. A move without a length has no spot, so its spot is the begin of
    /// the next move.
    std::optional<PathSpot> spot_of(const PathPlace& place) const;

    /// Calls visit(u, block) for each move that begins on a piece.
    template <typename Visit>
    void each_begin(std::size_t piece, Visit visit) const {
        const auto is_before = [](const Mark& mark, std::size_t number) { return mark.at.piece < number; };
        for (auto mark = std::lower_bound(marks_.begin(), marks_.end(), piece, is_before);
             mark != marks_.end() && mark->at.piece == piece; ++mark) {
            if (mark->along == Displacement{}) { visit(mark->at.u, mark->block); }
        }
    }

private:
    struct Mark {
        PathSpot at;
        std::uint32_t block = 0;
        Displacement along;
    };

    ReusedQueue<Quadratic> pieces_;
    SlidingVector<Mark> marks_;
    std::size_t first_ = 0;
    bool is_at_rest_ = true;  // at the end of the last piece
};

}  // namespace lockstep
