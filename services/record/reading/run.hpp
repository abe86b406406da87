// A frame or a tail that an axis's device has run, from the log, and the steps that it must have made.
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
#include "services/record/reading/steps/step_buffer.hpp"

namespace lockstep::analysis {

struct Run {
    std::int64_t incarnation = 0;  // of the axis's process; each process counts its runs from 0
    std::int64_t sequence = 0;     // without gaps
    Epoch epoch = 0;               // 0 for the axis's own moves
    FrameNumber frame = 0;
    bool tail = false;
    Tick start;
    Position from;  // machine coordinates
    std::vector<Piece> pieces;
    bool cut = false;             // the pulses stopped early, at stop_count
    std::int64_t stop_count = 0;  // at its end
    std::int64_t zero_count = 0;  // machine coordinates = device count - zero_count
    // Commanded times are machine time; all other times are device time.
    Ticks ahead{};                       // machine time minus device time, at the start
    std::vector<Ticks> commanded_ticks;  // of each piece; a split last piece counts as one; empty: as the pieces
    Ticks clock_error{};                 // steps are within this, plus two ticks, of the commanded time

    Position to() const;  // at the end of the pieces
    Ticks ticks() const;
    Tick commanded_start() const { return start + ahead; }  // machine time
    /// Whether its steps are commanded for their device's ticks.
    bool shares_time() const { return ahead == Ticks{} && commanded_ticks.empty(); }
    /// The device's counts, which zeroing does not change.
    std::int64_t device_start() const { return from.count() + zero_count; }
    std::int64_t device_stop() const { return stop_count + zero_count; }
};

/// The error names the impossible value: a piece that no engine executes, or a number that is too large.
std::expected<Run, std::string> to_run(const run_t& message);

/// A message of a run and what it contains, converted once for all readers.
struct RunMessage {
    std::string machine;
    std::string axis;
    std::int64_t utime = 0;
    std::expected<Run, std::string> run;
};
RunMessage to_run_message(const run_t& message);

/// "frame 12", "tail of frame 12", or "run 3, frame 1 of the axis's own move" outside any epoch.
std::string name_of(const Run& run);

/// Whether the run begins at rest on a whole step.
bool starts_from_rest(const Run& run);

/// Whether `run` follows `before` by its numbers, as the next frame of the same motion or as the tail of the same
/// frame.
bool is_next(const Run& before, const Run& run);

/// Makes the steps of a run one by one with the tick-exact engine.
class StepMaker {
public:
    explicit StepMaker(Run run);
    StepMaker(const StepMaker&) = delete;
    StepMaker& operator=(const StepMaker&) = delete;
    StepMaker(StepMaker&&) = default;
    StepMaker& operator=(StepMaker&&) = default;
    ~StepMaker() = default;

    const Run& run() const { return run_; }
    /// The next step; null at the end of the pieces.
    const StepEdge* next() {
        const StepSpan steps = ready();
        if (steps.empty()) { return nullptr; }
        next_ = steps.front();
        return &next_;
    }
    void pass() { count_ += ready_.direction(passed_++); }
    /// The next steps, as many as are made at once; empty at the end of the pieces.
    StepSpan ready() {
        if (passed_ == ready_.size()) { make_more(); }
        return ready_.subspan(passed_);
    }
    /// The machine time commanded for a ready step.
    Tick commanded_at(Tick tick) const { return commanded_.at(tick); }
    /// By how much a ready step's device time is later than its commanded machine time, if that is the same for all.
    std::optional<Ticks> ahead_of_commanded() const {
        if (commanded_.ticks != commanded_.other_ticks) { return std::nullopt; }
        return commanded_.from - commanded_.other_from;
    }
    /// Passes some of the ready steps, after which the position is `count`.
    void pass(std::size_t steps, std::int64_t count) {
        count_ = count;
        passed_ += steps;
    }
    /// The machine time commanded for the next step. There must be a next step.
    Tick commanded() { return commanded_.at(next()->tick); }
    /// The axis's position after the passed steps, in machine coordinates.
    std::int64_t count() const { return count_; }

private:
    static constexpr std::size_t kMadeAtOnce = 1024;
    void make_more();
    void begin_piece();

    Run run_;
    StepEngine engine_;
    std::size_t begun_ = 0;   // number of pieces begun
    ClockStretch commanded_;  // of the piece begun last, from device time to commanded time
    // The steps made last.
    std::vector<std::int32_t> ticks_;
    std::vector<std::int8_t> directions_;  // empty if they are the same
    StepSpan ready_;                       // of both
    std::size_t passed_ = 0;               // number of steps of ready_ passed
    StepEdge next_;
    std::int64_t count_;
};

}  // namespace lockstep::analysis
