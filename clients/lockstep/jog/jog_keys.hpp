// The keys of lockstep jog on a terminal. An axis is jogged while the terminal repeats its key. Pure.
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
    /// A key that has not come again for this time counts as released.
    static constexpr std::chrono::milliseconds kHold{150};

    explicit JogKeys(const MachineConfig& machine) : machine_(machine) {}

    /// Takes bytes from the terminal. `now`: the time of any monotonic clock.
    void take(std::string_view bytes, std::chrono::nanoseconds now);
    void release_all() { held_.clear(); }

    /// The axes to jog now.
    std::vector<JogAxis> jogs(std::chrono::nanoseconds now) const;
    bool must_quit() const { return must_quit_; }
    /// The axis's usual speed times the chosen percentage, at most its maximum velocity.
    double speed_mm_s(std::size_t axis) const;

    /// The keys of an axis for minus and plus, "left, right"; empty if it has none.
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
    std::map<Direction, std::chrono::nanoseconds> held_;  // with the time of the latest repetition
    std::string unread_;                                  // the first bytes of an incomplete key
    int speed_percent_ = 100;
    bool must_quit_ = false;
};

}  // namespace lockstep
