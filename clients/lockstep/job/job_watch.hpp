// Waits for the end of a job and prints its progress, events, pauses and stops.
#pragma once

#include <chrono>
#include <cstdint>
#include <expected>
#include <optional>

#include "clients/lockstep/job/event_lines.hpp"
#include "clients/lockstep/job/hang_up.hpp"
#include "clients/session/job_result.hpp"
#include "clients/session/session.hpp"
#include "clients/text/output.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {

class JobWatch {
public:
    /// `number`: the job's number, from the reply to `command`. `axes`: that home; 0: all.
    JobWatch(Session& session, std::uint64_t number, CommandKind command, AxisSet axes, Output& output,
             const StopSignal& stop, const HangUp& hang_up);

    /// A stop signal stops the machine on its path. A closed terminal holds the machine, or stops it if the job cannot
    /// be held. Then wait() waits for rest, with a limit. Fails if the coordinator fell silent or refused the stop, or
    /// if the job did not end in time.
    std::expected<JobResult, Failure> wait();
    /// Prints the events of the program that were received since the last call.
    void print_events();

private:
    Failure silent() const;
    Failure restless() const;
    /// Acts on each signal once.
    std::expected<void, Failure> follow_signals();
    std::expected<void, Failure> send_hold();
    std::expected<void, Failure> send_stop();
    void print_stall(const MachineState& state);
    void print_lost_lease();
    void print_phase(const MachineState& state);
    void print_pause(const MachineState& state, const std::string& at_line);
    void print_progress();

    Session& session_;
    std::uint64_t number_;
    CommandKind command_;
    AxisSet axes_;
    Output& output_;
    const StopSignal& stop_;
    const HangUp& hang_up_;
    EventLines event_lines_;
    Term asked_;
    Term runs_it_;  // of the owner last known to run the job
    bool is_lease_lost_ = false;
    bool hold_sent_ = false;
    bool stop_sent_ = false;
    std::optional<std::chrono::nanoseconds> rest_asked_;  // OwnerWatch::running_time() when the latest of both was sent
    std::optional<std::int32_t> line_;                    // the last line in motion
    std::optional<MachinePhase> printed_;
    std::optional<Pause> printed_pause_;
};

}  // namespace lockstep
