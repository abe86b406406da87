// The windows of speed and of acceleration that end with the steps of one motion (speed_meter.hpp says how long they
// are). Speeds are without sign.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "clients/analysis/measure/course.hpp"
#include "clients/analysis/measure/measured_step.hpp"
#include "services/record/reading/steps/step_span.hpp"

namespace lockstep::analysis {

class MotionWindows {
public:
    /// The number of steps in a block.
    static constexpr std::size_t kBlock = SampleBlock::kSize;
    /// The maximum number of steps that are added at once.
    static constexpr std::size_t kMostAdded = 4'096;

    bool empty() const { return past_.empty(); }
    std::size_t size() const { return past_.size(); }
    Tick tick(std::size_t step) const { return base_ + Ticks{past_[step]}; }
    Tick newest() const { return tick(size() - 1); }
    void clear();
    /// Whether a step is too far from the others. Clocks of a damaged log may jump.
    bool is_far(Tick tick) const {
        constexpr Ticks kFarthest{1 << 30};
        return !empty() && length_of(tick - base_) > kFarthest;
    }
    /// Makes room for `steps` steps, by dropping the oldest ones with which no window begins any more.
    void make_room(std::size_t steps) {
        if (past_.size() + steps > room_) { forget(); }
    }
    void add(Tick tick);
    /// Steps that belong to the same motion, for which there is room.
    void add(const StepSpan& steps);

    /// The acceleration between the windows that the newest step completes, then the speed in the window that it
    /// completes; nullopt if there is none. Call both once for each step.
    std::optional<Sample> acceleration();
    std::optional<Sample> speed();
    /// Whether the next steps certainly complete all windows.
    bool has_all_windows() const { return !empty() && late_first_ >= windows_from_; }

    struct Block {
        SampleBlock speed;
        SampleBlock acceleration;
    };
    /// The same for each of the kBlock steps from `from` on, times `sign`, and their rates. The steps before have been
    /// measured, and has_all_windows() was true.
    void measure(std::size_t from, double sign, Block& measured, StepRates* rates);

private:
    static constexpr std::int32_t kSpeedWindow = 1'000;
    static constexpr std::int32_t kAccelerationWindow = 10'000;
    static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

    double speed_since(std::size_t first) const {
        const std::size_t newest = size() - 1;
        return static_cast<double>(newest - first) / static_cast<double>(past_[newest] - past_[first]);
    }
    void forget();

    Tick base_;                       // of the ticks in past_ and window_from_
    std::vector<std::int32_t> past_;  // the newest steps of this motion, with which a window may still begin
    // The windows of acceleration that end with these steps, from step windows_from_ on: first tick and speed.
    std::vector<std::int32_t> window_from_;
    std::vector<double> window_speed_;
    std::size_t windows_from_ = kNone;
    std::size_t room_ = kMostAdded;  // maximum size of past_ before the oldest are dropped
    std::size_t speed_first_ = 0;    // begin of the windows that end with the newest step
    std::size_t late_first_ = 0;
};

}  // namespace lockstep::analysis
