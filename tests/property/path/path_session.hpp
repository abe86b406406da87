// A program that is interrupted, resumed, and turned to other overrides at given frames.
#pragma once

#include <deque>

#include "tests/property/path/random_path.hpp"

namespace lockstep {

/// Happens when `made` frames have been made. It is a turn to new overrides, or an interruption with `unrun` frames
/// that were not run.
struct SessionEvent {
    std::size_t made = 0;
    std::optional<Overrides> turn;
    std::size_t unrun = 0;
};

/// The frames that were run, and the tail behind the last of them, as a run that ends at rest.
inline PathRun run_to_rest(const PathRun& made, std::size_t ran) {
    PathRun run{.frames = {}, .from = made.from};
    run.frames.assign(made.frames.begin(), made.frames.begin() + static_cast<std::ptrdiff_t>(ran));
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
        made_.from.resize(setup.axes());
        planner_.begin(made_.from);
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
        if (!made_.frames.empty()) { runs_.push_back(made_); }
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
            frames_.push_back(**frame);
            made_.frames.push_back(std::move(**frame));
        }
    }

    /// Returns false if the event waits for more of the path.
    bool happen() {
        const SessionEvent event = events_.front();
        const TurnResult result = event.turn ? planner_.turn(*event.turn) : TurnResult::Taken;
        if (result == TurnResult::LacksPath) { return false; }
        events_.pop_front();
        if (!event.turn) { interrupt(event.unrun); }
        if (result == TurnResult::Taken) { happened_.push_back(event); }
        return true;
    }

    void interrupt(std::size_t unrun) {
        const std::size_t ran = made_.frames.size() - std::min(unrun, made_.frames.size());
        if (ran > 0 && made_.frames[ran - 1].last) { return; }
        if (ran > 0) {
            runs_.push_back(run_to_rest(made_, ran));
            place_ = made_.frames[ran - 1].rest;
            made_.from = end_of(runs_.back());
        }
        made_.frames.clear();
        planner_.resume(place_, made_.from);
    }

    PathPlanner planner_;
    std::deque<SessionEvent> events_;
    std::deque<SessionEvent> happened_;
    PathRun made_;  // since the machine rested
    PathPlace place_;
    std::vector<PathRun> runs_;
    std::vector<PathFrame> frames_;
};

/// Interruptions and overrides at random frames. Events are further apart if frames are short.
inline std::deque<SessionEvent> random_events(Random& random, const PathSetup& setup) {
    std::deque<SessionEvent> events;
    const std::uint64_t apart = setup.frame_ticks < Ticks{10'000} ? 60 : 6;
    std::size_t made = 0;
    for (int k = 0; k < 12; ++k) {
        made += 1 + random() % apart;
        SessionEvent event{.made = made, .turn = {}, .unrun = random() % 5};
        if (random() % 2 == 0) {
            const int feed = static_cast<int>(10 + random() % 191);
            event.turn = Overrides{.feed_percent = feed, .rapid_percent = static_cast<int>(10 + random() % 91)};
        }
        events.push_back(event);
    }
    return events;
}

}  // namespace lockstep
