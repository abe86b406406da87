// The course of an input or an output over time, in a bounded number of points, and when it is not known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "clients/drawing/thinned.hpp"
#include "core/hardware/output_change.hpp"
#include "core/units.hpp"

namespace lockstep::analysis {

/// A time in which changes may be missing from the log.
struct UnknownTime {
    Tick from;
    Tick to;
    bool operator==(const UnknownTime&) const = default;
};

/// From `at` on a value changes evenly, and stays at 0 and at 1 when it gets there.
struct ValueRamp {
    Tick at;
    double value = 0;  // share of full scale
    double slope = 0;  // for each tick

    double value_at(Tick tick) const;
    /// When it gets to 0 or 1; nullopt if never.
    std::optional<Tick> end() const;
};

class ChannelCourse {
public:
    /// Further unknown times are joined to the last one.
    static constexpr std::size_t kMostUnknown = 1000;

    ChannelCourse(std::string motor, ChannelEvent::Kind kind, int channel)
        : motor_(std::move(motor)), kind_(kind), channel_(channel) {}

    void change(const ValueRamp& ramp);
    /// Changes may be missing after `known`, until the next change.
    void lose(Tick known);
    /// Call once, at the end of the log.
    void finish(Tick end);

    const std::string& motor() const { return motor_; }
    ChannelEvent::Kind kind() const { return kind_; }
    int channel() const { return channel_; }
    /// x: ticks after origin(). y: the value, from 0 to 1. They do not join across unknown times.
    const std::vector<drawing::Point>& points() const { return curve_.points(); }
    Tick origin() const { return origin_; }
    Tick last_change() const { return last_change_; }
    /// Between the first change and the end.
    const std::vector<UnknownTime>& unknown() const { return unknown_; }

private:
    void run_to(Tick tick);
    void add(Tick tick, double value);
    void know_from(Tick tick);

    std::string motor_;
    ChannelEvent::Kind kind_;
    int channel_;
    Tick origin_;
    Tick newest_;
    Tick last_change_;
    bool has_begun_ = false;
    std::optional<ValueRamp> ramp_;     // nullopt: not known now
    std::optional<Tick> unknown_from_;  // if it has begun
    drawing::ThinnedCurve curve_;
    std::vector<UnknownTime> unknown_;
};

}  // namespace lockstep::analysis
