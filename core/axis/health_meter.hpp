// Measures how well an axis is doing: fed each loop with what happened, says it ten times a second. Reads no clock.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/axis/step_lateness.hpp"
#include "core/protocol/axis_health.hpp"

namespace lockstep {

/// Extremes of the last ten periods, which are a second.
class RecentExtremes {
public:
    void add(Ticks value) { periods_[newest_].add(value); }
    Extremes all() const;
    void begin_period();

private:
    std::array<Extremes, 10> periods_{};
    std::size_t newest_ = 0;
};

class HealthMeter {
public:
    HealthMeter(std::size_t axis, Identity identity, std::int64_t tick_ns);

    // Each loop in this order. Times are machine time.

    void look(Tick now, const DeviceStatus& device);
    /// What the controller decided: before its orders and tracks are put into the device's time.
    void take(const AxisOutputs& out);
    void step(StepEdge step);
    /// After the loop's steps; so much room the capture ring had before they were taken off.
    void end_loop(std::uint32_t free_captures);
    /// How long it was from when the loop was to begin until it was done.
    void loop_took(Ticks time);

    /// Once a tenth of a second. Of `refused`, what the meter has seen itself need not be told: frames and commands.
    std::optional<AxisHealth> report(Ticks clock_error, RefusalCounts refused);

private:
    void take_order(const DeviceOrder& order);
    LoopTime loop_time() const;
    void begin_period();

    static constexpr std::size_t kLoops = 1000;

    std::uint32_t axis_;
    Identity identity_;
    Ticks period_;
    Tick now_;
    std::optional<Tick> reported_;

    StepLateness lateness_of_;
    ReusedVector<ExecutedTrack> tracks_;  // of this loop
    std::optional<Tick> last_step_;
    std::uint64_t run_ = 0;  // begun last
    bool own_run_ = false;
    std::optional<Tick> newest_setpoint_;  // when it came; nothing where no other is to come

    RecentExtremes lateness_;
    RecentExtremes interval_;
    RecentExtremes slack_;
    RecentExtremes free_segments_;
    RecentExtremes free_captures_;
    std::array<Ticks, kLoops> loops_{};
    std::size_t loop_count_ = 0;
    std::uint64_t refused_frames_ = 0;
    std::uint64_t refused_commands_ = 0;
};

}  // namespace lockstep
