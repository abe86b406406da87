// The operator's overrides of a program's speeds.
#pragma once

namespace lockstep {

/// Feed moves run at `feed` times their programmed feed, rapid moves at `rapid` times the speed that the axes allow.
/// Neither takes an axis beyond its limits.
struct Overrides {
    static constexpr int kLeast = 10;
    static constexpr int kMost = 200;

    int feed_percent = 100;
    int rapid_percent = 100;

    static constexpr bool allows(int percent) { return percent >= kLeast && percent <= kMost; }
    constexpr double feed() const { return feed_percent / 100.0; }
    constexpr double rapid() const { return rapid_percent / 100.0; }
    bool operator==(const Overrides&) const = default;
};

}  // namespace lockstep
