// The axes that clients jog. Each moves by itself, and only while its client renews its command. Every renewal becomes
// an order to the axis that holds for a short time (MachineConfig::jog_hold_ticks). The axis brakes when no renewal
// follows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/coordinator/state/refusal.hpp"
#include "core/indices.hpp"
#include "core/static_vector.hpp"

namespace lockstep {

/// Whether an axis may be jogged at this speed, without its sign: from kLeastSpeed_mm_s to its max_velocity_mm_s.
bool is_jog_speed(const AxisConfig& axis, double speed_mm_s);
/// Says which speeds are possible.
std::string jog_speed_text(const AxisConfig& axis, double speed_mm_s);

/// The position, in steps, where a jog ends by itself: after its distance, at most at the end of the travel. An unhomed
/// axis does not know the ends of its travel.
std::int64_t jog_target(const JogAxis& asked, const AxisConfig& axis, std::int64_t here, bool is_homed);

class Jogs {
public:
    explicit Jogs(const MachineConfig& machine);

    /// Sets the axes that the client jogs from now on. Releases all other axes that it jogged before. Changes nothing
    /// if one of the axes is refused. The command counts as the first renewal.
    CommandResult press(const Command& command, const LoopView& loop);
    /// Takes a repeated command. Returns false if none of its axes is jogged any more.
    bool renew(const Command& command, const LoopView& loop);
    void release_all();

    /// Call it in each loop. Gives orders to the axes. Returns an axis that refused its order.
    std::optional<MotorIndex> advance(const LoopView& loop, AxisOrders& orders, std::vector<AxisCommand>& out);

    bool none() const;

private:
    struct Jog {
        MotorIndex motor;  // the axis's own
        Identity client = 0;
        std::uint64_t sequence = 0;  // of the command that began the jog
        JogAxis asked;
        Tick renewed;
        std::optional<std::int64_t> target;  // steps; empty: it was not ordered yet
    };
    /// The action for an axis in this loop.
    enum class Next { Nothing, Order, Renew, Halt, Forget, Report };

    std::expected<Jog, Refusal> jog_of(const JogAxis& asked, const Command& command, const LoopView& loop) const;
    Next next(AxisIndex axis, MotorIndex motor, const LoopView& loop, const AxisOrders& orders) const;
    static Next next_at_rest(const Jog& jog, const LoopView& loop);
    const AxisCommand& order(AxisIndex axis, const LoopView& loop, AxisOrders& orders);

    Ticks hold_;
    StaticVector<std::optional<Jog>, kMaxAxes> jogs_;  // by axis
};

}  // namespace lockstep
