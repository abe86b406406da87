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
#include <span>
#include <vector>

#include "clients/analysis/log/run.hpp"
#include "clients/analysis/measure/step_queue.hpp"

namespace lockstep::analysis {

struct LateStep {
    Tick commanded;
    Ticks late;              // negative: early
    Ticks error;             // uncertainty of `late`
    std::int64_t count = 0;  // after the step, machine coordinates
    std::int8_t direction = 0;
};

/// Some steps of one run, in the order of the commanded ticks.
struct LateSteps {
    std::span<const LateStep> steps;
    bool are_equally_late = false;  // known to be equally late, usually by 0 ticks

    LateSteps first(std::size_t count) const { return {steps.first(count), are_equally_late}; }
    LateSteps behind(std::size_t count) const { return {steps.subspan(count), are_equally_late}; }
};

/// Calls on_equal(steps) for each group of consecutive steps that are equally late.
template <typename OnEqual>
void for_equally_late(LateSteps late, OnEqual&& on_equal) {
    while (!late.steps.empty()) {
        const auto differs = [&](const LateStep& step) { return step.late != late.steps.front().late; };
        const auto end = late.are_equally_late ? late.steps.end() : std::ranges::find_if(late.steps, differs);
        const auto count = static_cast<std::size_t>(end - late.steps.begin());
        on_equal(late.steps.first(count));
        late = late.behind(count);
    }
}

/// All steps of one run. Any thread may read it.
struct LateRun {
    std::vector<LateStep> steps;
    bool are_equally_late = true;

    LateSteps all() const { return {steps, are_equally_late}; }
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
    void compare_first();
    LateRun compare(StepMaker maker);

    OnRun on_run_;
    StepQueue seen_;        // steps of no run yet
    std::deque<Run> runs_;  // ordered by their starts
    std::optional<Tick> last_tick_;
};

}  // namespace lockstep::analysis
