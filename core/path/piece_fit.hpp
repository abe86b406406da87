// Fits pieces of constant acceleration, common to all axes and in whole ticks, to a timed path.
//
// A piece is as long as possible. Both of its ends are on the path, its acceleration is the mean change of velocity, it
// stays within kFitShare of the path, and its speeds are near the path's. Every piece must pass the check that each
// axis makes of its frames (core/motion/piece_check.hpp). Pieces end at the tick nearest to a jump of the path, and at
// the end of the range.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/motion/piece_check.hpp"
#include "core/path/timed_path.hpp"

namespace lockstep {

/// The place up to which a frame could be made, and why not further.
struct FitFailure {
    enum class Why : std::uint8_t {
        NoPiece,  // no piece keeps the limits here
        Full,     // the frame has no room for more pieces
        Crowded,  // the frame has no room for what happens at the begins of its moves
    };
    Ticks at;  // from the begin of the frame
    Why why = Why::NoPiece;
};

class PieceFit {
public:
    explicit PieceFit(const PathSetup& setup);

    /// Fits at most `most` pieces to the ticks [0, end) of `path`, and moves `points` to their end.
    std::optional<FitFailure> fit(const TimedPath& path, Ticks end, std::size_t most, std::span<MotionPoint> points);
    /// The pieces of an axis that fit() has found.
    const std::vector<Piece>& pieces(MotorIndex motor) const { return fitted_[motor]; }

private:
    struct FitRange {
        Ticks begin;
        Ticks end;
        std::size_t first = 0;  // phases: the one of its first velocity, and the one of its last
        std::size_t last = 0;
    };

    Ticks next_break(Ticks now, Ticks end) const;
    FitRange range(Ticks begin, Ticks end) const;
    bool is_close(const FitRange& range, MotorIndex motor, double from, double v0, double a) const;
    const PathPhase& phase_at(const FitRange& range) const;
    double acceleration(const FitRange& range, MotorIndex motor) const;
    bool is_hard_reversal(MotorIndex i, double v0, double a, double ticks) const;
    bool try_piece(Ticks begin, Ticks end, std::span<const MotionPoint> points);
    Ticks longest(Ticks now, Ticks limit, std::span<const MotionPoint> points);
    Ticks longest_any(Ticks now, Ticks limit, std::span<const MotionPoint> points);

    static constexpr std::int64_t kShort_ticks = 32;  // no piece leaves less than this for the next one
    static constexpr double kSpeedTolerance = 0.01;   // of the start velocity

    const PathSetup& setup_;
    const TimedPath* path_ = nullptr;
    std::vector<std::vector<Piece>> fitted_;  // of each axis
    std::size_t phase_ = 0;                   // the last one that begins at or before now
    Ticks guess_;
    double tolerance_ = 1;       // times kSpeedTolerance
    std::vector<Piece> pieces_;  // of the last try that succeeded
    std::vector<MotionPoint> points_;
    std::vector<Piece> try_pieces_;
    std::vector<MotionPoint> try_points_;
};

}  // namespace lockstep
