// A jog of axes that do not move by themselves, because their motors must move together: a move on a path that lasts
// while its client renews its command. Like any path it begins some slots after the command, and a release brings it
// to rest by a veto.
#pragma once

#include <expected>
#include <optional>

#include "core/coordinator/state/refusal.hpp"
#include "core/program.hpp"

namespace lockstep {

/// Whether one of the jogged axes has no motor of its own.
bool needs_path(const Command& jog, const Kinematics& kinematics);

/// The line on which the axes move at their speeds until the first of them is at its end: after its distance, or at the
/// end of its travel. Axes that are there already, as nearly as their motors allow, are left out.
std::expected<Program, Refusal> jog_program(const Command& jog, const LoopView& loop);

class PathJog {
public:
    /// `renewed`: when its command came, or was last renewed; a line that follows another one is no renewal.
    PathJog(Command asked, Tick renewed, const LoopView& loop)
        : asked_(std::move(asked)), from_(loop.counts()), hold_(loop.machine.jog_hold_ticks()), renewed_(renewed) {}

    /// Takes a repeated command. Returns false if it is not this jog, or the one that follows.
    bool renew(const Command& command, const LoopView& loop);
    bool is_of(Identity client) const { return asked_.client == client; }
    Tick renewed() const { return renewed_; }
    bool is_released(Tick now) const { return now > renewed_ + hold_; }
    /// The client's new command asks for the same motion. A distance that is asked for again is another one.
    bool asks_the_same(const Command& next) const {
        return !replacement_ && !has_distance() && next.jogs == asked_.jogs;
    }
    void continue_by(Command next, const LoopView& loop);
    /// The client jogs other axes, or at other speeds, as soon as the machine has come to rest; or none.
    void replace(Command next, const LoopView& loop);
    /// Somebody stopped the machine, so a key that is still held moves it no more.
    void finish() { is_over_ = true; }
    /// The jog that follows when the machine rests: the replacement, or the rest of this one if its renewals were late
    /// or if it reached the end of one of several axes. nullopt: none.
    std::optional<Command> next(const LoopView& loop) const;

private:
    bool has_distance() const;
    std::optional<Command> rest_of_distance(const LoopView& loop) const;

    Command asked_;
    AxisCounts from_;  // where it began
    Ticks hold_;
    Tick renewed_;
    std::optional<Command> replacement_;
    bool is_over_ = false;
};

}  // namespace lockstep
