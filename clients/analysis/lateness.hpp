// How late one axis's steps were: each against the tick at which the frame it belongs to has it, in machine time.
//
// Frames alone are looked at, and their tails: what axes run together. Steps are found by their counts; where steps or
// runs are missing from the log, what cannot be told apart is left out.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "clients/analysis/run.hpp"
#include "clients/analysis/step_queue.hpp"

namespace lockstep::analysis {

struct LateStep {
    Tick commanded;
    Ticks late;              // below 0: before its time
    Ticks error;             // `late` is known within
    std::int64_t count = 0;  // after it, machine coordinates
    std::int8_t direction = 0;
};

/// Calls on_equal(steps) for each stretch of steps that are equally late: mostly all of a run are, by nothing.
template <typename OnEqual>
void for_equally_late(std::span<const LateStep> steps, OnEqual&& on_equal) {
    while (!steps.empty()) {
        const auto differs = [late = steps.front().late](const LateStep& step) { return step.late != late; };
        const auto end = std::ranges::find_if(steps, differs) - steps.begin();
        on_equal(steps.first(static_cast<std::size_t>(end)));
        steps = steps.subspan(static_cast<std::size_t>(end));
    }
}

/// Of one run, in the order of the ticks commanded; read on any thread.
using SharedLate = std::shared_ptr<const std::vector<LateStep>>;

class Lateness {
public:
    /// So long after a run's end its last steps are waited for: messages are sent every 10 ms. No step is taken to be
    /// later.
    static constexpr Ticks kPatience{100'000};
    /// An axis that rests while others move says nothing to wait for.
    static constexpr std::size_t kMaxWaiting = 256;

    using OnRun = std::function<void(const Run&, SharedLate)>;

    /// `on_run` hears of each run of an epoch, in the order of their starts.
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
    std::vector<LateStep> compare(StepMaker maker);

    OnRun on_run_;
    StepQueue seen_;        // and of no run yet
    std::deque<Run> runs_;  // by their starts
    std::optional<Tick> last_tick_;
};

}  // namespace lockstep::analysis
