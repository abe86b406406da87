// Waits for a job's end, and tells what happens meanwhile: progress, pauses, a stop that was asked for.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <optional>

#include "clients/lockstep/job/hang_up.hpp"
#include "clients/session/job_verdict.hpp"
#include "clients/session/session.hpp"
#include "clients/text/voice.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {

class JobWatch {
public:
    /// `number`: of the job, from the reply to `command`.
    JobWatch(Session& session, std::uint64_t number, CommandKind command, Voice& voice, const StopSignal& stop,
             const HangUp& hang_up);

    /// A stop signal stops the machine on its path, a closed terminal holds it, or stops what cannot be held; then rest
    /// is waited for, but not for ever. Error: the coordinator fell silent, or refused the stop, or the job goes on.
    std::expected<JobVerdict, Failure> wait();

private:
    Failure silent() const;
    Failure restless() const;
    /// What the signals that came ask for, once each.
    std::expected<void, Failure> follow_signals();
    std::expected<void, Failure> send_hold();
    std::expected<void, Failure> send_stop();
    void tell(const MachineState& state);
    void tell_progress();

    Session& session_;
    std::uint64_t number_;
    CommandKind command_;
    Voice& voice_;
    const StopSignal& stop_;
    const HangUp& hang_up_;
    Term asked_;
    Term runs_it_;  // who was last heard to
    bool hold_sent_ = false;
    bool stop_sent_ = false;
    std::optional<std::chrono::nanoseconds> rest_asked_;  // when the last of them was sent
    std::int32_t line_ = 0;                               // the last in motion
    std::optional<MachinePhase> told_;
};

}  // namespace lockstep
