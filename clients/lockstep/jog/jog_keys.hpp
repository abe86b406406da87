// The keys of lockstep jog on a terminal. An axis is jogged while the terminal repeats its key. With a distance, each
// press or repetition of a key is one step of that length. Pure.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/machine.hpp"
#include "core/protocol/messages.hpp"

namespace lockstep {

class JogKeys {
public:
    /// A key that has not come again for this time counts as released.
    static constexpr std::chrono::milliseconds kHold{150};

    /// `step_mm`: the length of a step; nullopt: no steps.
    explicit JogKeys(const MachineConfig& machine, std::optional<double> step_mm = {})
        : machine_(machine), step_mm_(step_mm) {}

    /// Takes bytes from the terminal. `now`: the time of any monotonic clock.
    void take(std::string_view bytes, std::chrono::nanoseconds now);
    void release_all() {
        held_.clear();
        next_step_.reset();
    }

    /// The axes to jog now.
    std::vector<JogAxis> jogs(std::chrono::nanoseconds now) const;
    bool makes_steps() const { return step_mm_.has_value(); }
    /// Returns the step that was asked for last, once. Call it when the step before is complete: repetitions of a key
    /// that come faster are left out.
    std::optional<JogAxis> take_step();
    /// Returns once whether space was pressed.
    bool take_stop() { return std::exchange(must_stop_, false); }
    bool must_quit() const { return must_quit_; }
    /// The axis's usual speed times the chosen percentage, at most its maximum velocity.
    double speed_mm_s(AxisIndex axis) const;

    /// The keys of an axis for minus and plus, "left, right"; empty if it has none.
    static std::string_view keys_of(AxisIndex axis);

private:
    struct Direction {
        AxisIndex axis;
        bool is_plus = false;
        auto operator<=>(const Direction&) const = default;
    };
    JogAxis jog_of(const Direction& direction) const;
    void press(std::string_view key, std::chrono::nanoseconds now);
    void change_speed(bool faster);

    const MachineConfig& machine_;
    std::optional<double> step_mm_;
    std::optional<Direction> next_step_;
    std::map<Direction, std::chrono::nanoseconds> held_;  // with the time of the latest repetition
    std::string unread_;                                  // the first bytes of an incomplete key
    int speed_percent_ = 100;
    bool must_stop_ = false;
    bool must_quit_ = false;
};

}  // namespace lockstep
