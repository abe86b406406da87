// How late one axis's steps were: each compared with its tick in its frame, in machine time.
//
// Only frames and their tails are compared: the runs that axes execute together. Steps are found by their counts; if
// steps or runs are missing from the log, ambiguous steps are left out.
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
    Ticks late;              // below 0: early
    Ticks error;             // uncertainty of `late`
    std::int64_t count = 0;  // after it, machine coordinates
    std::int8_t direction = 0;
};

/// Some steps of one run, in the order of the ticks commanded.
struct LateSteps {
    std::span<const LateStep> steps;
    bool are_equally_late = false;  // known to be equally late, usually 0

    LateSteps first(std::size_t count) const { return {steps.first(count), are_equally_late}; }
    LateSteps behind(std::size_t count) const { return {steps.subspan(count), are_equally_late}; }
};

/// Calls on_equal(steps) for each stretch of steps that are equally late.
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

/// All of one run; read on any thread.
struct LateRun {
    std::vector<LateStep> steps;
    bool are_equally_late = true;

    LateSteps all() const { return {steps, are_equally_late}; }
};
using SharedLate = std::shared_ptr<const LateRun>;

class Lateness {
public:
    /// How long after a run's end its last steps are awaited: messages are sent every 10 ms. Later steps are not
    /// considered.
    static constexpr Ticks kPatience{100'000};
    /// The maximum of waiting runs: an axis at rest while others move publishes no steps to wait for.
    static constexpr std::size_t kMaxWaiting = 256;
    /// The maximum of steps that wait for the record of their run; older ones belong to no run in the log. 64 MB.
    static constexpr std::size_t kMaxSeen = std::size_t{1} << 21;

    using OnRun = std::function<void(const Run&, SharedLate)>;

    /// `on_run` is called with each run of an epoch, in the order of their starts.
    explicit Lateness(OnRun on_run) : on_run_(std::move(on_run)) {}

    /// The next steps.
    void take(SharedSteps steps);
    void take(Run run);
    /// Call once, at the end of the log.
    void finish();

private:
    void settle();
    Tick first_end() const;
    void compare_first();
    LateRun compare(StepMaker maker);

    OnRun on_run_;
    StepQueue seen_;        // and of no run yet
    std::deque<Run> runs_;  // by their starts
    std::optional<Tick> last_tick_;
};

}  // namespace lockstep::analysis
