// The keys of lockstep jog on a terminal: which axes are jogged while the terminal repeats a key. Pure.
#pragma once

#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/machine.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class JogKeys {
public:
    /// A key that has not come again for so long is released.
    static constexpr std::chrono::milliseconds kHold{150};

    explicit JogKeys(const MachineConfig& machine) : machine_(machine) {}

    /// Takes the bytes that the terminal sent. `now`: the time of any monotonic clock.
    void take(std::string_view bytes, std::chrono::nanoseconds now);
    void release_all() { held_.clear(); }

    /// The axes to jog now.
    std::vector<JogAxis> jogs(std::chrono::nanoseconds now) const;
    bool must_quit() const { return must_quit_; }
    /// A share of the axis's own usual speed.
    double speed_mm_s(std::size_t axis) const;

    /// The keys of an axis, minus and plus: "left, right". Empty: it has none.
    static std::string_view keys_of(std::size_t axis);

private:
    struct Direction {
        std::size_t axis = 0;
        bool is_plus = false;
        auto operator<=>(const Direction&) const = default;
    };
    void press(std::string_view key, std::chrono::nanoseconds now);
    void change_speed(bool faster);

    const MachineConfig& machine_;
    std::map<Direction, std::chrono::nanoseconds> held_;  // and when it came last
    std::string unread_;                                  // the begin of a key's bytes
    int speed_percent_ = 100;
    bool must_quit_ = false;
};

}  // namespace lockstep
