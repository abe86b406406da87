// The coordinator, as a state machine with messages and time as inputs. It plans jobs, runs their epochs, homes axes
// and answers clients. Everything happens in `step`. It does no I/O and reads no clock.
#pragma once

#include <optional>

#include "core/coordinator/axis_watch.hpp"
#include "core/coordinator/command_inbox.hpp"
#include "core/coordinator/jobs/inherited_job.hpp"
#include "core/coordinator/jobs/job_lifecycle.hpp"
#include "core/coordinator/ownership.hpp"
#include "core/coordinator/switch_watch.hpp"
#include "core/coordinator/touch_watch.hpp"
#include "core/coordinator/writer_lease.hpp"
#include "core/protocol/slot_gate.hpp"

namespace lockstep {

class Coordinator {
public:
    /// `identity`: the machine time of its start in ticks, new at every start. The coordinator listens before it claims
    /// the machine. While another one owns the machine, it stands by if `standby` is given. `begin_steps`: the methods
    /// of the axes' own moves.
    Coordinator(const MachineConfig& machine, Identity identity, std::uint64_t config_hash, BeginSteps begin_steps,
                std::optional<OnTakeover> standby = std::nullopt, MakeRows make_rows = memory_rows);

    /// The programs that commands name.
    ProgramStore& programs() { return programs_; }

    /// Valid until the next step. The caller may complete the state before it publishes it.
    CoordinatorOutputs& step(const CoordinatorInputs& inputs);

    MachinePhase phase() const { return jobs_.activity().phase(); }
    /// The machine's present activity.
    const MachineActivity& activity() const { return jobs_.activity(); }
    bool owns_machine() const { return ownership_.owns(); }
    const WriterLease& lease() const { return lease_; }
    /// Its own term if it owns the machine, otherwise the highest that is known.
    Term term() const { return ownership_.term(); }

private:
    // Called on an owner and on a standby.
    bool is_late(Tick now);
    void receive(const CoordinatorInputs& inputs, CoordinatorLoop& loop);
    void receive(const AxisState& state, CoordinatorLoop& loop);
    void change_owner(PublishingLoop& loop);
    void take_over(PublishingLoop& loop);
    void stand_down(PublishingLoop& loop);
    void stand_by(PublishingLoop& loop);

    // Called on an owner only.
    void own(CoordinatorLoop& loop);
    void tend_lease(Slot missed, CoordinatorLoop& loop);
    void answer(const Command& command, CoordinatorLoop& loop);
    bool answer_about_lease(const Command& command, CoordinatorLoop& loop);
    void advance(CoordinatorLoop& loop);

    void report(PublishingLoop& loop) const;

    MachineConfig machine_;
    Kinematics kinematics_;
    std::uint64_t config_hash_;
    bool stands_by_;  // while another coordinator owns the machine; otherwise it quits
    Ticks slot_;
    Ownership ownership_;
    AxisRoster axes_;
    AxisOrders orders_;
    CommandInbox inbox_;
    WriterLease lease_;
    ProgramStore programs_;
    BeginSteps begin_steps_;
    JobLifecycle jobs_;
    TouchWatch touch_watch_;
    SwitchWatch switch_watch_;
    Inheritance inheritance_;
    AxisWatch watch_;
    SlotGate gate_;
    std::optional<Tick> stepped_;
    CoordinatorOutputs out_;
};

}  // namespace lockstep
