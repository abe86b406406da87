#include "clients/lockstep/job/job_watch.hpp"

#include <fmt/format.h>

#include <utility>

#include "clients/session/homing/homing_report.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/status_text.hpp"
#include "clients/session/waits.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep {
namespace {

constexpr std::chrono::milliseconds kGlance{100};  // maximum delay until a signal is noticed
/// The maximum time to come to rest after a stop. A healthy machine needs about a second, for the frames under way and
/// the tail.
constexpr std::chrono::seconds kRestPatience{10};

}  // namespace

JobWatch::JobWatch(Session& session, std::uint64_t number, CommandKind command, AxisSet axes, Output& output,
                   const StopSignal& stop, const HangUp& hang_up)
    : session_(session),
      number_(number),
      command_(command),
      axes_(axes),
      output_(output),
      stop_(stop),
      hang_up_(hang_up),
      event_lines_(number),
      asked_(session.state()->state.term),
      runs_it_(asked_) {}

std::expected<JobResult, Failure> JobWatch::wait() {
    for (;;) {
        session_.receive(kGlance);
        print_events();
        if (session_.is_silent()) { return std::unexpected(silent()); }
        const MachineState& state = session_.state()->state;
        const JobResult result = result_of(state, number_, asked_, runs_it_);
        if (result != JobResult::InProgress) { return result; }
        const bool rests = state.phase == MachinePhase::Holding || state.phase == MachinePhase::Paused;
        if (hang_up_.came() && rests && state.job == number_) { return JobResult::Held; }
        if (auto followed = follow_signals(); !followed) { return std::unexpected(followed.error()); }
        if (rest_asked_ && session_.owner().running_time() - *rest_asked_ > kRestPatience) {
            return std::unexpected(restless());
        }
        print_stall(state);
        print_lost_lease();
        if (state.job == number_) { print_phase(state); }
    }
}

void JobWatch::print_events() {
    for (const std::string& line : event_lines_.of(session_.take_events())) { output_.print(line); }
}

Failure JobWatch::silent() const {
    Failure failure = silence(session_);
    std::string& message = failure.errors.front().message;
    message = "the coordinator fell silent; the axes come to rest on the path by themselves. " + message;
    return failure;
}

Failure JobWatch::restless() const {
    return failed(
        fmt::format("the job has not ended within {} s of the stop; the machine may be in motion: lockstep status; "
                    "to stop all pulses at once: lockstep estop",
                    kRestPatience.count()));
}

std::expected<void, Failure> JobWatch::follow_signals() {
    if (hang_up_.came() && !hold_sent_) { return send_hold(); }
    if (stop_.requested() && !stop_sent_) { return send_stop(); }
    return {};
}

std::expected<void, Failure> JobWatch::send_hold() {
    hold_sent_ = true;
    rest_asked_ = session_.owner().running_time();
    const auto reply = send_command(session_, {.kind = CommandKind::Hold});
    if (!reply) { return std::unexpected(reply.error()); }
    return reply->status == ReplyStatus::Accepted ? std::expected<void, Failure>{} : send_stop();
}

std::expected<void, Failure> JobWatch::send_stop() {
    stop_sent_ = true;
    rest_asked_ = session_.owner().running_time();
    output_.print(command_ == CommandKind::Home ? "stopping ..." : "stopping on the path ...");
    const auto reply = send_command(session_, {.kind = CommandKind::Stop});
    if (!reply) { return std::unexpected(reply.error()); }
    const bool has_ended = reply->fault == FaultCode::NothingToDo;
    if (reply->status == ReplyStatus::Accepted || has_ended) { return {}; }
    return std::unexpected(failed("the stop was refused: " + reply->text +
                                  "; the machine continues; to stop all pulses at once: lockstep estop"));
}

/// The coordinator did not wait for this command: the job is where its state says.
void JobWatch::print_stall(const MachineState& state) {
    const auto stall = session_.owner().take_stall();
    if (!stall) { return; }
    const bool rests = state.phase == MachinePhase::Holding || state.phase == MachinePhase::Paused;
    output_.print(fmt::format("this command was itself stopped for {:.0f} s, in which it watched nothing; the job {}",
                              std::chrono::duration<double>(*stall).count(),
                              rests ? "is held" : "went on and continues"));
}

void JobWatch::print_lost_lease() {
    const LeaseKeeper& lease = session_.lease();
    if (lease.state() != LeaseKeeper::State::Lost || std::exchange(is_lease_lost_, true)) { return; }
    output_.print(lease.answer()->text + "; the job continues, and can be held or stopped from here");
}

void JobWatch::print_phase(const MachineState& state) {
    if (state.line) { line_ = state.line; }
    const std::string at_line = line_ ? fmt::format(" at line {}", *line_) : "";
    if (state.term != runs_it_ && state.phase != MachinePhase::Waiting) {
        runs_it_ = state.term;
        output_.print("another coordinator has taken over and continues the job" + at_line);
    }
    if (state.pause) { return print_pause(state, at_line); }
    printed_pause_.reset();
    const bool rests = state.phase == MachinePhase::Holding;
    if (rests && state.phase != printed_) {
        output_.print("held" + at_line + ": continue with: lockstep resume; end the job with: lockstep stop");
    }
    printed_ = state.phase;
    if (!rests) { print_progress(); }
}

/// A pause lasts while axes are jogged and return in it.
void JobWatch::print_pause(const MachineState& state, const std::string& at_line) {
    const bool returns = state.phase == MachinePhase::Running;
    if (returns && printed_ != state.phase) { output_.print("returning to the place of the pause"); }
    printed_ = state.phase;
    if (printed_pause_ == state.pause->why) { return; }
    printed_pause_ = state.pause->why;
    if (state.pause->why.reason == PauseReason::Input) {
        return output_.print(fmt::format("{}{}\nit goes on by itself; end the job with: lockstep stop",
                                         text_of(state.pause->why), at_line));
    }
    output_.print(
        fmt::format("paused{}: {}\ncontinue with: lockstep resume; end the job with: lockstep stop; jog and touch off "
                    "in the pause with: lockstep jog, lockstep touch",
                    at_line, text_of(state.pause->why)));
}

void JobWatch::print_progress() {
    const proto::StatusReport status = status_report(session_);
    if (command_ == CommandKind::Home) { return output_.progress(homing_text(status, axes_)); }
    output_.progress(output_.is_terminal() ? progress_bar(status) : progress_text(status));
}

}  // namespace lockstep
