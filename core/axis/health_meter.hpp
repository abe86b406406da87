// Measures the health of an axis from what happens in each loop, and reports it ten times a second. Reads no clock.
#pragma once

#include <array>
#include <optional>

#include "core/axis/step_lateness.hpp"
#include "core/protocol/axis_health.hpp"

namespace lockstep {

/// Extremes of the last ten periods, which last a second together.
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
    HealthMeter(MotorIndex motor, Identity identity, std::int64_t tick_ns);

    // Call these functions in each loop, in this order. Times are machine time.

    /// `device`: null if the axis has none.
    void look(Tick now, const DeviceStatus* device);
    /// Takes what the controller decided, before its orders and tracks are converted to the device's time.
    void take(const AxisOutputs& out);
    void step(StepEdge step);
    /// Call it after the loop's steps. `free_captures`: room in the capture ring before these steps were read.
    void end_loop(std::uint32_t free_captures);
    /// Takes the time from when the loop was due until its end.
    void loop_took(Ticks time);

    /// Returns a report each tenth of a second. `refused` need not contain frames and commands, because the meter
    /// counts these.
    std::optional<AxisHealth> report(Ticks clock_error, RefusalCounts refused);

private:
    void take_order(const DeviceOrder& order);
    LoopTime loop_time() const;
    void begin_period();

    static constexpr std::size_t kLoops = 1000;

    MotorIndex motor_;
    Identity identity_;
    Ticks period_;
    Tick now_;
    std::optional<Tick> reported_;

    StepLateness lateness_of_;
    ReusedVector<ExecutedTrack> tracks_;  // of this loop
    std::optional<Tick> last_step_;
    std::uint64_t run_ = 0;  // the last run begun
    bool own_run_ = false;
    std::optional<Tick> newest_setpoint_;  // when the newest frame arrived; empty if no other is awaited

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
