// What an operator's dials make of the speeds that a program asks for.
#pragma once

namespace lockstep {

/// In percent of what is programmed. Feed moves go at `feed` of their feed, rapid ones at `rapid` of what the axes
/// allow. Neither ever takes an axis beyond its limits.
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
