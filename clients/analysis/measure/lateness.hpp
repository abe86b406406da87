// Measures how late one axis's steps were. Compares each step with its tick in its frame, in machine time.
//
// Only the runs that axes execute together are compared: frames and their tails. Steps are identified by their counts.
// If steps or runs are missing from the log, ambiguous steps are left out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "clients/analysis/measure/step_queue.hpp"
#include "services/record/reading/run.hpp"

namespace lockstep::analysis {

/// Consecutive steps of one run and one message that are equally late.
struct EquallyLate {
    StepSpan steps;           // in machine time, as they were made; at least one
    std::int64_t before = 0;  // the position before them, machine coordinates
    std::int64_t change = 0;  // of the position by them
    Ticks late;               // negative: early
    Ticks error;              // uncertainty of `late`

    Tick commanded(std::size_t step) const { return steps.tick(step) - late; }
    bool is_one_way() const { return change == std::ssize(steps) || -change == std::ssize(steps); }
    /// The first `count` steps, and the others. `count`: at least one, and not all for behind().
    EquallyLate first(std::size_t count) const;
    EquallyLate behind(std::size_t count) const;
};

/// The steps of one run. Any thread may read it.
struct LateRun {
    std::vector<StepEdges> messages;  // that contain the steps
    std::vector<EquallyLate> groups;  // in the order of the commanded ticks
};
using SharedLate = std::shared_ptr<const LateRun>;

class Lateness {
public:
    /// How long after a run's end its last steps are awaited. Messages are sent every 10 ms. Later steps are ignored.
    static constexpr Ticks kPatience{100'000};
    /// The maximum number of waiting runs. An axis at rest publishes no steps, so its runs wait while others move.
    static constexpr std::size_t kMaxWaiting = 256;
    /// The maximum number of steps that wait for the record of their run (64 MB). Older steps belong to no run in the
    /// log.
    static constexpr std::size_t kMaxSeen = std::size_t{1} << 21;

    using OnRun = std::function<void(const Run&, SharedLate)>;

    /// Calls `on_run` with each run of an epoch, in the order of their starts.
    explicit Lateness(OnRun on_run) : on_run_(std::move(on_run)) {}

    /// Takes the next steps.
    void take(SharedSteps steps);
    void take(Run run);
    /// The axis has reported its position at this time, so its steps before are in the log.
    void pass(Tick tick);
    /// Call once, at the end of the log.
    void finish();

private:
    void settle();
    Tick first_end() const;
    bool is_next(StepMaker& maker) const;
    static std::size_t equally_late(const StepMaker& maker, const StepSpan& seen, const StepSpan& made, Ticks late);
    bool compare_ready(StepMaker& maker, LateRun& run);
    void compare_first();
    LateRun compare(StepMaker maker);

    OnRun on_run_;
    StepQueue seen_;        // steps of no run yet
    std::deque<Run> runs_;  // ordered by their starts
    std::optional<Tick> last_tick_;
};

}  // namespace lockstep::analysis
