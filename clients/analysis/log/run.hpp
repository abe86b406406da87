// A frame or a tail that an axis's device has run, from the log; and the steps that it must have made.
#pragma once

#include <cstdint>
#include <expected>
#include <lockstep/run_t.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/clock/clock_view.hpp"
#include "core/protocol/messages.hpp"
#include "core/step/engine.hpp"

namespace lockstep::analysis {

struct Run {
    std::int64_t incarnation = 0;  // of the axis's process; each process counts its runs from 0
    std::int64_t sequence = 0;     // without gaps
    Epoch epoch = 0;               // 0: the axis's own move
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Position from;  // machine coordinates
    std::vector<Piece> pieces;
    bool cut = false;             // pulses ceased early, at stop_count
    std::int64_t stop_count = 0;  // at its end
    std::int64_t zero_count = 0;  // machine coordinates = device count - zero_count
    // What was commanded is in machine time; all else is in the device's.
    Ticks ahead{};                         // machine time less the device's, at the start
    std::vector<Ticks> commanded_ticks{};  // of each piece; one split at the end is one. Empty: as the pieces last
    Ticks clock_error{};                   // its steps are within this, plus two ticks, of the commanded time

    Position to() const;  // where its pieces end
    Ticks ticks() const;
    Tick commanded_start() const { return start + ahead; }  // machine time
    /// The device's own counts, which zeroing does not change.
    std::int64_t device_start() const { return from.count() + zero_count; }
    std::int64_t device_stop() const { return stop_count + zero_count; }
};

/// The error names the impossible value: pieces that no engine executes, numbers that are too large.
std::expected<Run, std::string> to_run(const run_t& message);

/// "frame 12", "tail of frame 12", or "run 3, frame 1 of the axis's own move" outside any epoch.
std::string name_of(const Run& run);

/// Whether it begins at rest on a whole step.
bool starts_from_rest(const Run& run);

/// From their numbers: the next frame of the same motion, or the tail after the frame before.
bool is_next(const Run& before, const Run& run);

/// The steps of a run, one by one, as the tick-exact engine makes them.
class StepMaker {
public:
    explicit StepMaker(Run run);

    const Run& run() const { return run_; }
    /// The next step; null at the end of the pieces.
    const StepEdge* next() {
        if (passed_ == made_.size()) { make_more(); }
        return passed_ < made_.size() ? &made_[passed_] : nullptr;
    }
    void pass() { count_ += made_[passed_++].direction; }
    /// The machine time that was commanded for the next step. There must be a next step.
    Tick commanded() { return commanded_.at(next()->tick); }
    /// Where the axis is after the steps passed, machine coordinates.
    std::int64_t count() const { return count_; }

private:
    static constexpr std::size_t kMadeAtOnce = 4096;
    void make_more();
    void begin_piece();

    Run run_;
    StepEngine engine_;
    std::size_t begun_ = 0;   // pieces
    ClockStretch commanded_;  // of the piece begun last, from the device's time
    std::vector<StepEdge> made_;
    std::size_t passed_ = 0;  // of made_
    std::int64_t count_;
};

}  // namespace lockstep::analysis
