#include "clients/web/machine/snapshot_taker.hpp"

#include <utility>

#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

/// Nullopt unless all motors rest, and no homing brings them together.
std::optional<MotorApart> motor_apart(const Session& session) {
    const Kinematics& kinematics = session.received().kinematics();
    if (kinematics.is_direct() || !session.state() || session.state()->state.phase == MachinePhase::Homing) {
        return {};
    }
    MotorCounts counts;
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        const auto& motor = session.received().motor(m);
        if (!motor || !motor->state.at_rest) { return {}; }
        counts.steps.append(motor->state.position.count());
    }
    const auto astray = kinematics.astray(counts);
    return astray ? std::optional(MotorApart{kinematics.motors()[astray->motor].name, astray->off_mm}) : std::nullopt;
}

}  // namespace

void SnapshotTaker::note_healths() {
    for (const MotorIndex i : motor_indices(healths_.size())) {
        const auto& health = session_.received().health(i);
        if (!health || (healths_[i] && healths_[i]->value.tick == health->tick)) { continue; }
        healths_[i] = Seen<AxisHealth>{*health, monotonic_now()};
    }
}

AxisSnapshot SnapshotTaker::axis(AxisIndex i) const {
    const auto own = session_.received().kinematics().own_motor(i);
    AxisSnapshot taken{.is_present = session_.received().axis_present(i),
                       .is_process = own.has_value(),
                       .steps_per_tick = session_.received().axis_speed(i),
                       .state = {},
                       .health = {}};
    if (own) { taken.health = healths_[*own]; }
    if (const auto& state = session_.received().axis(i)) { taken.state = Seen<AxisState>{state->state, state->time}; }
    return taken;
}

/// Those that are not the only motor of an axis.
std::vector<MotorSnapshot> SnapshotTaker::motors() const {
    const Kinematics& kinematics = session_.received().kinematics();
    std::vector<MotorSnapshot> taken;
    for (const MotorIndex m : motor_indices(kinematics.motors().size())) {
        const MotorConfig& config = kinematics.motors()[m];
        if (config.axis && kinematics.own_motor(*config.axis) == m) { continue; }
        MotorSnapshot motor{
            .name = config.name,
            .is_board = config.is_board(),
            .axes = kinematics.names_of_axes(kinematics.axes_of_motor(m)),
            .steps_per_mm = config.steps_per_mm,
            .seen = {.is_present = session_.received().motor_present(m), .state = {}, .health = healths_[m]}};
        if (const auto& state = session_.received().motor(m)) {
            motor.seen.steps_per_tick = state->state.velocity.steps_per_tick();
            motor.seen.state = Seen<AxisState>{state->state, state->time};
        }
        taken.push_back(std::move(motor));
    }
    return taken;
}

Snapshot SnapshotTaker::take() const {
    Snapshot snapshot{.time = monotonic_now()};
    if (const auto& state = session_.state()) { snapshot.machine = Seen<MachineState>{state->state, state->time}; }
    snapshot.is_silent = session_.is_silent();
    snapshot.has_standby = session_.has_standby();
    snapshot.config_differs = session_.config_differs();
    for (const AxisIndex i : axis_indices(session_.config().axes.size())) { snapshot.axes.push_back(axis(i)); }
    snapshot.motors = motors();
    snapshot.apart = motor_apart(session_);
    snapshot.values = session_.values().newest();
    snapshot.values_unsaved_since = session_.values().unsaved_since();
    return snapshot;
}

}  // namespace lockstep::web
