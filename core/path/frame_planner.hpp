// Frames of a path: for each frame the pieces of all axes, and the tail that brings them to rest on the path.
//
// A frame is made when the path is known far enough (SpeedWindow::known). If no pieces keep an axis's limits, or a
// frame or a tail would need more pieces than it can carry, the path is slowed down before that place and the frame is
// made again. The speed at the beginning of the frame stays fixed. Speeds are lowered only to values that braking can
// reach from there.
#pragma once

#include <array>
#include <expected>
#include <optional>
#include <vector>

#include "core/path/path_speed.hpp"
#include "core/path/piece_fit.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// The part of the path that one Frame carries.
struct PathFrame {
    Ticks ticks;
    bool last = false;                 // the path ends with it, at rest
    PathPlace begin;                   // the place in the program where it begins
    PathPlace rest;                    // the place where the machine rests if it is the last one that is run
    std::array<PathPlace, 16> places;  // the place at the begin of each sixteenth of the frame
    std::vector<AxisTrack> axes;
    std::vector<PathSpeed> speeds;       // in the body; both are empty unless PathSetup::tells_speeds
    std::vector<PathSpeed> tail_speeds;  // in the tail
};

/// The time at which a move of the program begins, in ticks from the begin of a frame or of its tail.
struct MoveBegin {
    std::uint32_t block = 0;
    double at = 0;
};

/// Says whether a frame has room for everything that happens at the begins of its moves.
class FrameRoom {
public:
    virtual ~FrameRoom() = default;
    virtual bool has_room(std::span<const MoveBegin> body, std::span<const MoveBegin> tail, bool is_last) = 0;
};

/// An error: even from rest no frame keeps the limits, because they contradict each other.
struct PathStuck {
    PathPlace at;
};

struct FrameCounts {
    std::int64_t slowed = 0;  // frames that had to be made again, slower
    std::int64_t braked = 0;  // frames that followed the tail of the previous frame
};

/// Where a frame begins.
struct FrameCursor {
    std::size_t interval = 0;
    double begin = 0;          // of the interval, in ticks from the frame's begin: at most 0
    double w0 = 0;             // at this begin
    std::optional<double> w1;  // at its end; present if the interval is under way and is passed as planned
    double u = 0;              // the place on the interval's piece where the frame begins
    double w = 0;              // at this place
    StaticVector<MotionPoint, kMaxAxes> points;
};

class FramePlanner {
public:
    FramePlanner(const PathSetup& setup, SpeedWindow& window, const PathTrail& trail)
        : setup_(setup), window_(window), trail_(trail), fit_(setup), overridden_(setup) {}
    /// An independent copy, with references to copies of the other planner's objects.
    FramePlanner(const FramePlanner& other, const PathSetup& setup, SpeedWindow& window, const PathTrail& trail);
    FramePlanner(const FramePlanner&) = delete;
    FramePlanner& operator=(const FramePlanner&) = delete;

    /// The axes rest at `at`, where the window's path begins.
    void begin(std::span<const Position> at);
    /// Returns the next frame, valid until the next call, or null while too little of the path is known. Must not be
    /// called after the last frame. A frame without `room` is made again, slower.
    std::expected<const PathFrame*, PathStuck> next(FrameRoom* room = nullptr);
    /// Whether the path is known far enough for the next frame.
    bool is_ready();
    bool is_done() const { return is_done_; }
    /// The moves that begin in the frame that `next` returned last. A move at its end may be listed for two frames.
    const std::vector<MoveBegin>& begins() const { return begins_; }
    /// Those that begin in its tail.
    const std::vector<MoveBegin>& tail_begins() const { return tail_begins_; }
    /// Whether a frame has been made since begin().
    bool has_made() const { return has_made_; }
    /// Starts again after the window was refilled. Only before the first frame.
    void restart() { has_begun_ = is_traced_ = false; }
    /// Applies new overrides from the end of the last frame on. Changes nothing unless it returns Taken.
    OverrideResult set_overrides(const Overrides& overrides);
    const FrameCounts& counts() const { return counts_; }

private:
    bool start();
    bool trace();
    std::optional<FitFailure> fit(PathFrame& frame, FrameCursor& behind, FrameRoom* room);
    std::optional<FitFailure> fit_body(PathFrame& frame, FrameCursor& next);
    bool fit_tail(PathFrame& frame, const FrameCursor& from);
    void slow_down(const FitFailure& failure, Ticks ticks, int attempt);
    void start_slower(double slower);
    void brake();
    PathPlace place_of_rest(const PathFrame& frame, const FrameCursor& behind) const;
    void take(const FrameCursor& next);

    static constexpr int kAttempts = 16;
    static constexpr double kSlower = 0.7;             // of the square of the speed
    static constexpr double kSlowest = 0.2;            // the strongest factor; used when half of the attempts failed
    static constexpr std::int64_t kSlowTicks = 8192;   // the path is slowed for this long before a place without pieces
    static constexpr std::int64_t kMargin_ticks = 64;  // the path must be known for this long behind a frame

    const PathSetup& setup_;
    SpeedWindow& window_;
    const PathTrail& trail_;
    FrameCursor at_;
    TimedPath path_;
    TimedPath tail_;
    TimedPath held_tail_;  // of the last frame; only its times and places are used
    PieceFit fit_;
    PathFrame made_;                 // the frame that is being made
    PathFrame last_;                 // the frame before it
    std::vector<MoveBegin> begins_;  // in the last frame
    std::vector<MoveBegin> tail_begins_;
    SpeedWindow overridden_;  // set_overrides: the window with the new overrides
    bool is_traced_ = false;  // path_ begins at the cursor
    bool has_begun_ = false;
    bool has_made_ = false;
    bool is_done_ = false;
    FrameCounts counts_;
};

}  // namespace lockstep
