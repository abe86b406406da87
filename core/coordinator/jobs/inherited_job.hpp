// The job of the last owner, from the takeover until this coordinator continues or ends it.
#pragma once

#include <expected>
#include <optional>

#include "core/coordinator/jobs/takeover.hpp"
#include "core/coordinator/state/coordinator_loop.hpp"

namespace lockstep {

class InheritedJob {
public:
    /// `on_takeover`: empty if this coordinator does not stand by.
    InheritedJob(std::optional<OnTakeover> on_takeover, std::uint64_t config_hash)
        : on_takeover_(on_takeover), config_hash_(config_hash) {}

    /// A client has asked another owner to hold or stop.
    void note_interrupt(Slot now) { interrupted_ = now; }
    void begin(const MachineState& last) { last_ = last; }
    /// Call it when the job was continued or ended.
    void end() { last_.reset(); }
    void forget() { last_.reset(), interrupted_.reset(); }

    bool exists() const { return last_.has_value(); }
    /// The newest state of the last owner.
    const MachineState& last() const { return *last_; }

    /// Returns why the job cannot be continued, as far as that is known before all axes follow.
    std::optional<TakeoverDoubt> doubt(const CoordinatorLoop& loop) const;
    /// Call it when every axis follows this coordinator and rests. The program must be known.
    std::expected<JobRest, TakeoverDoubt> rest(const KnownProgram& program, const CoordinatorLoop& loop) const;

private:
    std::optional<OnTakeover> on_takeover_;
    std::uint64_t config_hash_;
    std::optional<MachineState> last_;
    std::optional<Slot> interrupted_;
};

}  // namespace lockstep
