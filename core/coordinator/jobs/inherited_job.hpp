// The job of the last owner, from the takeover until this coordinator continues or ends it.
#pragma once

#include <cstdint>
#include <optional>

#include "core/coordinator/jobs/job_lifecycle.hpp"

namespace lockstep {

class Inheritance {
public:
    /// `on_takeover`: empty if this coordinator does not stand by.
    Inheritance(std::optional<OnTakeover> on_takeover, std::uint64_t config_hash)
        : on_takeover_(on_takeover), config_hash_(config_hash) {}

    /// This coordinator owns the machine now. `last`: the newest state of the last owner. Its job is kept until it can
    /// be continued, or ended if it cannot.
    void take_over(const std::optional<MachineState>& last, JobLifecycle& jobs, PublishingLoop& loop) const;
    /// Call it when every axis follows this coordinator and rests. Continues an inherited job, as soon as the program
    /// is at hand, or leaves Waiting without one.
    static void leave_waiting(JobLifecycle& jobs, CoordinatorLoop& loop);

private:
    std::optional<TakeoverDoubt> doubt(const MachineState& last, std::optional<Slot> interrupted,
                                       const LoopView& loop) const;

    std::optional<OnTakeover> on_takeover_;
    std::uint64_t config_hash_;
};

}  // namespace lockstep
