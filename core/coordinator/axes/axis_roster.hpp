// The motors as the coordinator knows them, each by its process: which are present, and the newest state of each.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/coordinator/axes/axis_view.hpp"
#include "core/kinematics/motor_inputs.hpp"
#include "core/kinematics/motors.hpp"
#include "core/motion/path.hpp"

namespace lockstep {

class AxisRoster {
public:
    explicit AxisRoster(const MachineConfig& machine)
        : timing_(machine.timing), inputs_(machine), views_(motor_count(machine)) {}

    /// How a received state relates to what is known of its motor.
    enum class Arrival : std::uint8_t {
        Ignored,    // old, out of order, not of this machine, or of another process that was not confirmed yet
        SameAxis,   // from the known process
        FirstSeen,  // from a motor that was not known
        Replaced    // from a process that replaces the known one, which is silent for longer than it may stall
    };
    Arrival arrival_of(const AxisState& state, Slot now);
    /// Keeps a state that is not to be ignored.
    void take(const AxisState& state, Slot now);

    /// Slots missed in the coordinator's own stall do not count as a motor's silence. After a long stall another
    /// coordinator may own the machine.
    void forgive(Slot missed, Slot now);
    /// True after a long stall until every present axis was received in two slots. Until then it is not known which
    /// owner they follow.
    bool is_unsettled(Slot now);

    std::size_t size() const { return views_.size(); }
    std::span<const AxisView> views() const { return views_; }
    /// Empty if the motor was never received or is gone.
    const std::optional<AxisState>& state(MotorIndex motor) const { return views_[motor].state; }
    bool is_present(MotorIndex motor, Slot now) const { return views_[motor].present(now, timing_); }
    void forget(MotorIndex motor) { views_[motor].state.reset(); }
    void forget_missing(Slot now);

    std::optional<MotorIndex> missing(Slot now) const;
    std::optional<MotorIndex> without_device() const;
    std::optional<MotorIndex> not_homed() const;
    /// The motor's clock error may exceed this limit.
    bool is_uncertain(MotorIndex motor, Ticks limit) const;
    std::optional<MotorIndex> uncertain(Ticks limit) const;
    /// Returns a motor that is present and not at rest; nullopt if there is none.
    std::optional<MotorIndex> moving(Slot now) const;
    bool all_rest() const;
    /// The first of the machine's inputs with this use that is closed; nullopt if there is none.
    std::optional<std::size_t> closed_input(InputUse use) const;
    /// Whether this input of the machine is closed. Nullopt: it is not known from a state stamped in slot `since` or
    /// later.
    std::optional<bool> is_closed(std::size_t input, Slot since = 0) const;
    /// A motor whose emergency stop input is closed, or that was stopped by it and not reset yet; nullopt: there is
    /// none.
    std::optional<MotorIndex> stopped_by_input() const;
    MotorSet present(Slot now) const;
    /// Positions of the slides in whole steps; 0 for a motor that is not known.
    MotorCounts counts() const;

private:
    ProtocolTiming timing_;
    MotorInputs inputs_;
    std::vector<AxisView> views_;
    std::optional<Slot> woken_;  // when a stall ended in which another coordinator may have taken over
};

}  // namespace lockstep
