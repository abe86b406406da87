// The coordinator, as a state machine with messages and time as inputs. It plans jobs, runs their epochs, homes axes
// and answers clients. Everything happens in `step`. It does no I/O and reads no clock.
#pragma once

#include <optional>

#include "core/coordinator/command_inbox.hpp"
#include "core/coordinator/jobs/inherited_job.hpp"
#include "core/coordinator/jobs/job_lifecycle.hpp"
#include "core/coordinator/ownership.hpp"
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

    /// Takes a whole program. Command::program names it. Only the newest few are kept.
    void accept_program(std::uint64_t id, const Program& program) { programs_.accept(id, program); }
    /// From now on a command that names the program is refused. Its job continues.
    void forget_program(std::uint64_t id) { programs_.forget(id); }

    /// Valid until the next step. The caller may complete the state before it publishes it.
    CoordinatorOutputs& step(const CoordinatorInputs& inputs);

    MachinePhase phase() const { return jobs_.activity().phase(); }
    /// A job is in motion, held, or inherited by a takeover.
    bool has_job() const { return jobs_.has_job(); }
    /// A job waits for a person, and nothing moves.
    bool is_paused() const { return phase() == MachinePhase::Paused; }
    bool owns_machine() const { return ownership_.owns(); }
    /// Whether this writer may send programs and edits now. A standby refuses nothing, because the owner does.
    CommandResult check_writer(std::uint64_t writer, Tick now) const { return lease_.check(writer, now); }
    const std::optional<HeldLease>& lease() const { return lease_.held(); }
    /// Its own term if it owns the machine, otherwise the highest that is known.
    Term term() const { return ownership_.term(); }

private:
    // Called on an owner and on a standby.
    bool is_late(Tick now);
    void receive(const CoordinatorInputs& inputs, CoordinatorLoop& loop);
    void receive(const AxisState& state, CoordinatorLoop& loop);
    void receive(const ProgramPart& part, CoordinatorLoop& loop);
    void change_owner(CoordinatorLoop& loop);
    void take_over(CoordinatorLoop& loop);
    void stand_down(CoordinatorLoop& loop);
    void stand_by(CoordinatorLoop& loop);
    void refuse_as_standby(const Command& command, Slot now);

    // Called on an owner only.
    void own(CoordinatorLoop& loop);
    void tend_lease(Slot missed, CoordinatorLoop& loop);
    void watch_stop_inputs(CoordinatorLoop& loop);
    void watch_axis(std::size_t axis, CoordinatorLoop& loop);
    void lose_axis(std::size_t axis, CoordinatorLoop& loop);
    void lose_outputs(std::size_t axis, CoordinatorLoop& loop);
    void answer(const Command& command, CoordinatorLoop& loop);
    bool answer_about_lease(const Command& command, CoordinatorLoop& loop);
    CommandResult carry_out(const Command& command, CoordinatorLoop& loop);
    CommandResult reset(CoordinatorLoop& loop);
    CommandResult stop_at_once(CoordinatorLoop& loop);
    void advance(CoordinatorLoop& loop);
    bool are_axes_ready(const CoordinatorLoop& loop) const;
    void wait_for_axes(CoordinatorLoop& loop);

    void report(CoordinatorLoop& loop) const;
    std::optional<Epoch> devices_after() const;

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
    Inheritance inheritance_;
    SlotGate gate_;
    std::optional<Tick> stepped_;
    bool is_stopped_by_input_ = false;
    CoordinatorOutputs out_;
};

}  // namespace lockstep
