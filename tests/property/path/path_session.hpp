// A program that is interrupted, resumed, and turned to other overrides at given frames.
#pragma once

#include <deque>
#include <span>

#include "tests/property/path/random_path.hpp"

namespace lockstep {

/// Happens when `made` frames have been made. It is a change of the overrides, or an interruption with `unrun` frames
/// that were not run.
struct SessionEvent {
    std::size_t made = 0;
    std::optional<Overrides> overrides;
    std::size_t unrun = 0;
};

/// The frames that were run from a place, and the tail behind the last of them, as a run that ends at rest.
inline PathRun run_to_rest(std::span<const PathFrame> ran, std::vector<Position> from) {
    PathRun run{.frames = {ran.begin(), ran.end()}, .from = std::move(from)};
    PathFrame tail{.ticks = total_ticks(run.frames.back().axes[0].tail), .axes = run.frames.back().axes};
    for (AxisTrack& track : tail.axes) {
        for (const Piece& piece : track.body) { track.from = track.from + piece.covered(); }
        track.body.clear();
        for (const Piece& piece : track.tail) { track.body.append(piece); }
        track.tail.clear();
    }
    if (tail.ticks > Ticks{}) { run.frames.push_back(tail); }
    run.frames.back().last = true;
    return run;
}

inline PathRun run_to_rest(const PathRun& made, std::size_t ran) {
    return run_to_rest(std::span(made.frames).first(ran), made.from);
}

inline std::vector<Position> end_of(const PathRun& run) {
    std::vector<Position> at;
    for (const AxisTrack& track : run.frames.back().axes) {
        at.push_back(track.from);
        for (const Piece& piece : track.body) { at.back() = at.back() + piece.covered(); }
    }
    return at;
}

class PathSession {
public:
    PathSession(const PathSetup& setup, std::deque<SessionEvent> events) : planner_(setup), events_(std::move(events)) {
        from_.resize(setup.axes());
        planner_.begin(from_);
    }

    /// Plans the program. Takes frames behind move k if `drains(k)` is true.
    void run(const TestProgram& program, const std::function<bool(std::size_t)>& drains) {
        for (std::size_t k = 0; k < program.moves.size(); ++k) {
            give(planner_, program.moves[k], static_cast<std::uint32_t>(k + 1));
            if (drains(k)) { ASSERT_NO_FATAL_FAILURE(drain()); }
        }
        planner_.finish();
        ASSERT_NO_FATAL_FAILURE(drain());
        ASSERT_TRUE(planner_.is_done());
        const std::span made = since_rest();
        if (!made.empty()) { runs_.push_back({.frames = {made.begin(), made.end()}, .from = from_}); }
    }

    /// The runs between two rests. Each begins where the previous one ends.
    const std::vector<PathRun>& runs() const { return runs_; }
    /// The events that did happen.
    const std::deque<SessionEvent>& happened() const { return happened_; }
    /// All frames made, whether they were run or not.
    const std::vector<PathFrame>& frames() const { return frames_; }

private:
    void drain() {
        while (true) {
            while (!events_.empty() && events_.front().made == frames_.size()) {
                if (!happen()) { return; }
            }
            if (planner_.is_done()) { return; }
            auto frame = planner_.next();
            ASSERT_TRUE(frame) << "stuck in block " << frame.error().at.block;
            if (!*frame) { return; }
            frames_.push_back(std::move(**frame));
        }
    }

    /// Returns false if the event waits for more of the path.
    bool happen() {
        const SessionEvent event = events_.front();
        const OverrideResult result =
            event.overrides ? planner_.set_overrides(*event.overrides) : OverrideResult::Taken;
        if (result == OverrideResult::LacksPath) { return false; }
        events_.pop_front();
        if (!event.overrides) { interrupt(event.unrun); }
        if (result == OverrideResult::Taken) { happened_.push_back(event); }
        return true;
    }

    void interrupt(std::size_t unrun) {
        const std::span made = since_rest();
        const std::span ran = made.first(made.size() - std::min(unrun, made.size()));
        if (!ran.empty() && ran.back().last) { return; }
        if (!ran.empty()) {
            runs_.push_back(run_to_rest(ran, from_));
            place_ = ran.back().rest;
            from_ = end_of(runs_.back());
        }
        rest_ = frames_.size();
        planner_.resume(place_, from_);
    }

    std::span<const PathFrame> since_rest() const { return std::span(frames_).subspan(rest_); }

    PathPlanner planner_;
    std::deque<SessionEvent> events_;
    std::deque<SessionEvent> happened_;
    std::vector<PathFrame> frames_;
    std::size_t rest_ = 0;  // the frames that were made when the machine rested
    std::vector<Position> from_;
    PathPlace place_;
    std::vector<PathRun> runs_;
};

/// Interruptions and overrides at random frames. Events are further apart if frames are short.
inline std::deque<SessionEvent> random_events(Random& random, const PathSetup& setup) {
    std::deque<SessionEvent> events;
    const std::uint64_t apart = setup.frame_ticks < Ticks{10'000} ? 60 : 6;
    std::size_t made = 0;
    for (int k = 0; k < 12; ++k) {
        made += 1 + random() % apart;
        SessionEvent event{.made = made, .overrides = {}, .unrun = random() % 5};
        if (random() % 2 == 0) {
            const int feed = static_cast<int>(10 + random() % 191);
            event.overrides = Overrides{.feed_percent = feed, .rapid_percent = static_cast<int>(10 + random() % 91)};
        }
        events.push_back(event);
    }
    return events;
}

}  // namespace lockstep
