// Measures the step skew between axes: how far apart the steps of two axes are, compared with a common clock.
//
// The lateness of a step is (tick made) - (tick commanded). At each step of either axis, the skew of a pair is the
// difference between the lateness of both axes' newest steps of the same frame. It is measured in machine time, so its
// uncertainty is that of both axes' clocks, or 0 if one clock drives all devices.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clients/analysis/measure/lateness.hpp"

namespace lockstep::analysis {

/// The skew of one pair of axes, without signs.
struct PairSkew {
    std::string first;
    std::string second;
    std::int64_t steps = 0;  // number of steps at which it was measured
    Ticks median;
    Ticks p99;
    Ticks largest;
    Ticks error;  // uncertainty of each value
};

class SkewMeter {
public:
    /// The maximum number of waiting frames. A frame waits until every axis has delivered a later one.
    static constexpr std::size_t kFramesWaiting = 64;

    using OnLate = std::function<void(const std::string& axis, const SharedLate& steps)>;
    /// Calls `on_late` with the steps of each frame, axis by axis.
    explicit SkewMeter(OnLate on_late) : on_late_(std::move(on_late)) {}

    /// Call at the first message of an axis.
    void add(const std::string& axis) { lateness(axis); }
    /// The next steps of an axis.
    void take(const std::string& axis, SharedSteps steps) { lateness(axis).take(std::move(steps)); }
    void pass(const std::string& axis, Tick tick) { lateness(axis).pass(tick); }
    void take(const std::string& axis, Run run) { lateness(axis).take(std::move(run)); }
    /// Call once, at the end of the log. Returns the pairs that ran frames together.
    std::vector<PairSkew> finish();

private:
    using Steps = std::map<std::string, SharedLate>;  // of one frame or tail, by axis
    struct FrameKey {
        Tick start;
        Epoch epoch = 0;
        auto operator<=>(const FrameKey&) const = default;
    };

    Lateness& lateness(const std::string& axis);
    void on_run(const std::string& axis, const Run& run, SharedLate steps);
    bool all_are_past_first_frame() const;
    void take_first_frame();
    /// How often each amount occurred, and the largest error.
    struct Amounts {
        std::map<Ticks, std::int64_t> times;
        Ticks error;
    };

    /// An axis's steps of a frame.
    struct AxisSteps {
        std::string axis;
        SharedLate late;
        std::size_t size = 0;
        Tick first;  // of the commanded ticks
        Tick last;
        bool are_equally_late = true;
        std::vector<std::uint64_t> bits;  // the commanded ticks, as a bit for each tick of the frame; empty: few steps
        std::vector<Tick> commanded;      // in order; empty until they are needed
        /// The number of steps that are commanded for this tick or later.
        std::int64_t from(Tick tick) const;
        const std::vector<Tick>& ticks();
    };
    static AxisSteps steps_of(const Steps::value_type& axis);
    static void note_bits(std::vector<AxisSteps>& axes);
    static std::int64_t common_ticks(AxisSteps& a, AxisSteps& b);
    static std::int64_t common_bits(const AxisSteps& a, const AxisSteps& b);
    static std::int64_t ticks_of_both(AxisSteps& a, AxisSteps& b);
    static void take_steps(AxisSteps& a, AxisSteps& b, Amounts& amounts);
    static PairSkew summary_of(const std::pair<std::string, std::string>& axes, const Amounts& amounts);
    void take_pair(AxisSteps& a, AxisSteps& b);

    OnLate on_late_;
    std::map<std::string, std::unique_ptr<Lateness>> axes_;
    std::map<std::string, FrameKey> latest_;  // the latest frame that each axis has delivered
    std::map<FrameKey, Steps> frames_;
    std::map<std::pair<std::string, std::string>, Amounts> skews_;
};

}  // namespace lockstep::analysis
