// Frames of a path: for each frame the pieces of all axes, and the tail that brings them to rest on the path.
//
// A frame is made when the path is known far enough (SpeedWindow::known). Where no pieces keep an axis's limits, or a
// frame or a tail would need more pieces than it can carry, the path is slowed down before that place and the frame is
// made again. The speed at the beginning of the frame is fixed then; no speed is asked for that braking cannot reach
// from there.
#pragma once

#include <array>
#include <expected>
#include <optional>
#include <vector>

#include "core/path/piece_fit.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

/// What a Frame carries of the path.
struct PathFrame {
    Ticks ticks;
    bool last = false;                 // the path ends with it, at rest
    PathPlace begin;                   // where on the program it begins,
    PathPlace rest;                    // and where the machine rests if it is the last one that is run
    std::array<PathPlace, 16> places;  // where it is at the begin of each sixteenth of the frame
    std::vector<AxisTrack> axes;
};

/// When a move of the program begins, in ticks from the begin of a frame.
struct MoveBegin {
    std::uint32_t block = 0;
    double at = 0;
};

/// Not even from rest a frame keeps the limits: they contradict each other.
struct PathStuck {
    PathPlace at;
};

class FramePlanner {
public:
    FramePlanner(const PathSetup& setup, SpeedWindow& window, const PathTrail& trail)
        : setup_(setup), window_(window), trail_(trail), fit_(setup), turned_(setup) {}
    /// A copy that goes on by itself, with copies of what the other one refers to.
    FramePlanner(const FramePlanner& other, const PathSetup& setup, SpeedWindow& window, const PathTrail& trail);
    FramePlanner(const FramePlanner&) = delete;
    FramePlanner& operator=(const FramePlanner&) = delete;

    /// The axes rest at `at`, where the window's path begins.
    void begin(std::span<const Position> at);
    /// The next frame, valid until the next call; null while too little of the path is known. Not after the last one.
    std::expected<const PathFrame*, PathStuck> next();
    /// The path is known far enough for it.
    bool is_ready();
    bool is_done() const { return is_done_; }
    /// The moves that begin in the frame that `next` returned last. One at its end may be named for two frames.
    const std::vector<MoveBegin>& begins() const { return begins_; }
    /// Since begin().
    bool has_made() const { return has_made_; }
    /// The window was made anew, and no frame has been made.
    void restart() { has_begun_ = is_traced_ = false; }
    /// New overrides, from the next node behind the last frame. Nothing has changed unless they were taken.
    TurnResult turn(const Overrides& overrides);
    /// Frames that had to be made again, slower.
    std::int64_t slowed() const { return slowed_; }
    /// Frames that went along the tail of the one before.
    std::int64_t braked() const { return braked_; }

private:
    /// Where a frame begins.
    struct Cursor {
        std::size_t interval = 0;
        double begin = 0;  // of the interval, in ticks from the frame's: at most 0
        double w0 = 0;
        std::optional<double> w1;  // the interval is under way: it is finished as it was planned
        double u = 0;              // Straight: where the frame begins
        StaticVector<MotionPoint, kMaxAxes> points;
    };

    bool start();
    bool trace();
    void note_places(PathFrame& frame, const TimedPath& path) const;
    void note_begins(Ticks ticks);
    Ticks end_of_frame() const;
    std::optional<FitFailure> fit_body(PathFrame& frame, Cursor& next);
    bool fit_tail(PathFrame& frame, const Cursor& from);
    void trace_tail(const Cursor& from);
    Cursor cursor_at(const TimedPath& path, Ticks t, bool is_braking) const;
    void slow_down(const FitFailure& failure, Ticks ticks, int attempt);
    void start_slower(double slower);
    void brake();
    PathPlace place_of_rest(const PathFrame& frame, const Cursor& behind) const;
    void take(const Cursor& next);

    static constexpr int kAttempts = 16;
    static constexpr double kSlower = 0.7;             // of the square of the speed
    static constexpr double kSlowest = 0.2;            // at once; likewise if half of the attempts did not suffice
    static constexpr std::int64_t kSlowTicks = 8192;   // before a place without pieces the path is slowed for so long
    static constexpr std::int64_t kMargin_ticks = 64;  // that the path must be known for behind a frame

    const PathSetup& setup_;
    SpeedWindow& window_;
    const PathTrail& trail_;
    Cursor at_;
    TimedPath path_;
    TimedPath tail_;
    TimedPath held_tail_;  // of the last frame; its times and ways only are used
    PieceFit fit_;
    PathFrame made_;                 // the frame that is being made
    PathFrame last_;                 // the frame before it
    std::vector<MoveBegin> begins_;  // in the last frame
    SpeedWindow turned_;             // turn: the window with the new overrides
    bool is_traced_ = false;         // path_ begins at the cursor
    bool has_begun_ = false;
    bool has_made_ = false;
    bool is_done_ = false;
    std::int64_t slowed_ = 0;
    std::int64_t braked_ = 0;
};

}  // namespace lockstep
