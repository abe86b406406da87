// The intervals of the path in a window that moves with the motion, and the passes over them.
//
// A backward pass from rest at the end of the known path finds each interval's `reach`. If that equals the limit of the
// place itself, later pieces cannot change anything before the place: all intervals up to there are final. A pass runs
// when the number of intervals that are not final has doubled: amortized constant work for each piece.
#pragma once

#include "core/path/interval.hpp"
#include "core/path/sliding_vector.hpp"
#include "core/reused_queue.hpp"

namespace lockstep {

class IntervalWindow {
public:
    /// The end of the path is known. All intervals are then final.
    bool is_finished() const { return is_finished_; }

    /// Intervals are numbered from the beginning. Those from first() up to end() are stored, those up to known() have a
    /// final end.
    std::size_t first() const { return first_; }
    std::size_t end() const { return first_ + intervals_.size(); }
    std::size_t known() const;
    const Interval& interval(std::size_t number) const { return intervals_[number - first_]; }
    /// The interval that contains the place u of a piece.
    std::size_t interval_at(std::size_t piece, double u) const;
    const JoinedPiece& piece_of(const Interval& part) const { return pieces_[part.piece - first_piece_]; }
    const Quadratic& shape_of(const Interval& part) const { return piece_of(part).shape; }
    IntervalBounds bounds(const Interval& part) const { return {setup_, piece_of(part), part}; }
    /// The greatest w at the end of an interval from which all later limits can be kept.
    double reach_behind(std::size_t number) const;

    /// Moves the beginning of an interval to u, and sets w there.
    void cut(std::size_t number, double u, double w);
    /// Lowers the cap of an interval's beginning, or of the end of the path.
    void lower(std::size_t number, double cap);
    /// Computes `reach` again for the intervals [first, last].
    void update(std::size_t first, std::size_t last);
    /// Slows a straight interval: multiplies the square of its greatest speed by `slower`. A rest is divided by it,
    /// up to `enough`.
    void slow(std::size_t number, double slower, Ticks enough);
    /// Drops everything before an interval.
    void drop_before(std::size_t number);
    static constexpr std::size_t kMaxOpen = 16384;  // intervals that are not final; at more, half are made final

protected:
    explicit IntervalWindow(const PathSetup& setup) : setup_(setup) {}

    void clear(std::size_t first_piece);
    /// Many intervals are not final, so it is time for a pass.
    bool is_due() const { return end() - final_ >= due_; }
    /// Passes over the intervals that are not final.
    void look_ahead();

    PathSetup setup_;
    ReusedQueue<JoinedPiece> pieces_;  // phases refer to them
    SlidingVector<Interval> intervals_;
    std::size_t first_ = 0;
    std::size_t first_piece_ = 0;
    bool is_open_ = false;   // the last piece has no intervals, because the next one is not known
    std::size_t final_ = 0;  // all intervals before this one are final
    double end_cap_ = 0;     // w at the end of the path, once it is finished
    bool is_finished_ = false;

private:
    static constexpr std::size_t kLeastPass = 32;

    std::size_t due_ = kLeastPass;  // a pass runs when this many are not final
};

}  // namespace lockstep
