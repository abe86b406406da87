#include "clients/lockstep/job/job.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "clients/lockstep/job/final_positions.hpp"
#include "clients/lockstep/job/job_watch.hpp"
#include "clients/session/control/lease_turn.hpp"
#include "clients/session/control/probe_touch.hpp"
#include "clients/session/control/program_parts.hpp"
#include "clients/session/inputs/input_report.hpp"
#include "clients/session/record_loss.hpp"
#include "clients/session/refusal.hpp"
#include "clients/session/reports.hpp"
#include "clients/session/status_text.hpp"
#include "clients/session/waits.hpp"
#include "clients/text/format.hpp"
#include "clients/text/notes.hpp"
#include "services/runtime/clock.hpp"
#include "services/runtime/stop_signal.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

constexpr nanoseconds kEventPatience = 1s;  // until events of the coordinator are received

std::string outcome_name(JobResult result) {
    switch (result) {
        case JobResult::Done: return "done";
        case JobResult::Stopped: return "stopped";
        case JobResult::Held: return "held";
        case JobResult::Failed: return "failed";
        case JobResult::CutShort: return "cut-short";
        case JobResult::InProgress: return "begun";
        case JobResult::Lost: break;
    }
    return "lost";
}

std::string title(const Job& job) {
    return job.name.empty() || job.name == job.kind ? job.kind : job.kind + " " + job.name;
}

std::string cut_short_text(const proto::RunReport& report) {
    std::string text = "the coordinator fell silent and another has taken over; the axes rest on the path";
    if (!report.has_line()) { return text; }
    return fmt::format("{0} near line {1}; the rest of the job: lockstep run FILE --from-line {1}", text,
                       report.line());
}

std::string stopped_text(const Job& job, const Session& session) {
    if (job.command != CommandKind::Home) { return "stopped on the path; the rest of the job is dropped"; }
    return unhomed_text(status_report(session));
}

void print_end(const Session& session, const Job& job, const proto::RunReport& report, Output& output) {
    const std::string time = report.has_real_s() ? " after " + duration_text(report.real_s()) : "";
    const std::string place =
        report.final_positions().empty()
            ? "the positions of its axes are not known, because no messages are received from them"
            : "at " + places_text(report);
    output.print(wrapped(title(job) + ": " + report.outcome() + time + "; " + place, 80, "  "));
    if (report.has_fault()) { output.print(fault_text(report.fault())); }
    if (report.outcome() == "stopped") { output.print(stopped_text(job, session)); }
    if (report.outcome() == "held") { output.print("continue with: lockstep resume; end the job with: lockstep stop"); }
    if (report.outcome() == "cut-short") { output.print(wrapped(cut_short_text(report), 80, "  ")); }
    if (report.outcome() == "lost") {
        output.print(
            "the job's end is not known, because another job or coordinator followed it; see: lockstep status");
    }
}

proto::RunReport new_report(const Job& job) {
    proto::RunReport report;
    report.set_kind(job.kind);
    report.set_name(job.name);
    if (job.planned_s) { report.set_planned_s(*job.planned_s); }
    return report;
}

std::expected<Reply, Failure> begin(Session& session, const Job& job, const StopSignal& stop) {
    std::uint64_t program = 0;
    if (job.stream != nullptr) {
        const auto begun = send_part(session, *job.stream, &stop);
        if (!begun) { return std::unexpected(begun.error()); }
        program = *begun;
    }
    if (job.program) {
        const auto sent = send_program(session, *job.program, &stop, job.values);
        if (!sent) { return std::unexpected(sent.error()); }
        program = *sent;
    }
    const Command command{.kind = job.command, .axes = job.axes, .program = program, .ticks = job.ticks};
    auto reply = send_command(session, command, &stop);
    if (reply || !stop.requested()) { return reply; }
    (void)send_command(session, {.kind = CommandKind::Stop});
    return std::unexpected(
        failed("interrupted before the coordinator answered: it is not known whether the job began, so "
               "a stop was sent; see: lockstep status"));
}

/// Waits until the program's offsets and tools are on the coordinator's disk.
void await_kept_values(Session& session, const Job& job, Output& output) {
    const bool changes = job.values && job.values->after;
    const auto kept = job.stream != nullptr ? await_kept(session, *job.stream)
                      : changes             ? await_kept(session, job.values->revision + 1)
                                            : std::expected<void, Failure>{};
    if (!kept) { output.warn(kept.error().errors.front().message); }
}

/// Warns if the machine did not run all of a program that was read while it ran, and says why.
void report_stream(const Session& session, const Job& job, Output& output) {
    warn_of(job.stream->take_notes(), output);
    if (const auto& trouble = job.stream->trouble()) {
        output.warn(
            fmt::format("{0}:{1}:{2}: {3}\nthe lines before it were run; correct this line and continue: "
                        "lockstep run FILE --from-line {1}",
                        job.name, trouble->line, trouble->column, trouble->message));
    } else if (const auto& refusal = session.upload().sender()->refusal()) {
        output.warn(job.name + ": the coordinator accepts no more of the program: " + refusal->text);
    }
}

ExitCode end_begun(const Job& job, proto::RunReport& report, Output& output) {
    report.set_outcome(outcome_name(JobResult::InProgress));
    output.report(report);
    output.print(fmt::format("{}: begun as job {}; see: lockstep watch", title(job), report.job()));
    return kExitDone;
}

/// Call before the job begins, to receive its first events too.
void follow_events(Session& session, const Job& job, Output& output) {
    if (job.command != CommandKind::Run || job.detach) { return; }
    if (!session.receive_until(kEventPatience, [&] { return session.follow_events(); })) {
        output.warn("events of programs are not received from every coordinator; some may not be printed");
    }
}

/// Prints the result of the job's probing move.
std::expected<ProbeTouch, Failure> report_touch(Session& session, proto::RunReport& report, Output& output) {
    auto touch = touch_of(session, report.job());
    if (!touch) { return touch; }
    const proto::ProbeReport probe = probe_report(session.config(), *touch);
    output.print(wrapped(report.name() + ": " + text_of(probe), 80, "  "));
    *report.add_probes() = probe;
    return touch;
}

/// Reads the next part of a program, behind its probing move.
std::expected<void, Failure> read_on(Session& session, ProgramStream& stream, proto::RunReport& report,
                                     Output& output) {
    const auto touch = report_touch(session, report, output);
    if (!touch) { return std::unexpected(touch.error()); }
    const auto read = read_next_part(session, stream, *touch);
    warn_of(stream.take_notes(), output);
    return read;
}

ExitCode end(Session& session, const Job& job, JobResult result, JobWatch& watch, proto::RunReport& report,
             Output& output) {
    report.set_outcome(outcome_name(result));
    if (result == JobResult::Failed) {
        if (auto fault = fault_of(session.state()->state, session.config())) {
            *report.mutable_fault() = *std::move(fault);
        }
    }
    const MachineState& state = session.state()->state;
    if (result == JobResult::Stopped && state.job_fault != FaultCode::None) {
        *report.mutable_fault() = fault_report(state.job_fault, "");
        name_closed_probes(status_report(session), *report.mutable_fault());
        if (state.line) { report.set_line(*state.line); }
    }
    if (result == JobResult::CutShort && state.line) { report.set_line(*state.line); }
    add_final_positions(session, report);
    watch.print_events();
    if (result == JobResult::Done) { await_kept_values(session, job, output); }
    std::string conclusion;
    if (result == JobResult::Done && job.conclude) {
        auto concluded = job.conclude(report);
        if (!concluded) { return output.fail(concluded.error()); }
        conclusion = *std::move(concluded);
    }
    output.report(report);
    print_end(session, job, report, output);
    if (!conclusion.empty()) { output.print(wrapped(conclusion, 80, "  ")); }
    return result == JobResult::Done ? kExitDone : kExitFailed;
}

}  // namespace

ExitCode run_job(Session& session, const Job& job, Output& output) {
    if (session.config_differs()) { output.warn("the coordinator runs another configuration than this command reads"); }
    const StopSignal stop;
    const HangUp hang_up;
    proto::RunReport report = new_report(job);
    const std::uint64_t lost = lost_records(status_report(session));
    const LeaseTurn turn(session, job.take, &stop);
    if (!turn.answer()) { return output.fail(turn.answer().error()); }
    if (turn.is_refused()) { return print_refusal(title(job), *turn.answer(), report, output); }
    follow_events(session, job, output);
    const nanoseconds begun = monotonic_now();
    std::optional<JobWatch> watch;
    std::optional<JobResult> result;
    while (!result) {
        const auto reply = begin(session, job, stop);
        if (!reply) { return output.fail(reply.error()); }
        if (reply->status == ReplyStatus::Refused) { return print_refusal(title(job), *reply, report, output); }
        report.set_job(reply->job);
        if (job.detach && job.stream != nullptr) {
            if (const auto sent = send_rest(session, &stop); !sent) { return output.fail(sent.error()); }
        }
        if (job.detach && job.stream != nullptr && job.stream->awaits_touch()) {
            output.warn("the program probes: the lines behind its first probing move are not run; leave --detach out");
        }
        if (job.detach) { return end_begun(job, report, output); }
        output.print(fmt::format("{}: job {}{}", title(job), reply->job,
                                 job.planned_s ? ", planned to take " + duration_text(*job.planned_s) : ""));
        watch.emplace(session, reply->job, job.command, job.axes, output, stop, hang_up);
        const auto part = watch->wait();
        if (!part) { return output.fail(part.error()); }
        if (job.stream != nullptr) { report_stream(session, job, output); }
        result = *part;
        if (result == JobResult::Done && job.probes) {
            if (const auto touch = report_touch(session, report, output); !touch) { return output.fail(touch.error()); }
        }
        if (result != JobResult::Done || job.stream == nullptr || !job.stream->awaits_touch()) { continue; }
        if (const auto read = read_on(session, *job.stream, report, output); !read) {
            return output.fail(read.error());
        }
        if (!job.stream->is_empty()) { result.reset(); }
    }
    report.set_real_s(static_cast<double>((monotonic_now() - begun).count()) * 1e-9);
    report.set_lost_records(std::max(lost, lost_records(status_report(session))) - lost);
    if (report.lost_records() > 0) { output.warn(record_loss_text(status_report(session))); }
    return end(session, job, *result, *watch, report, output);
}

}  // namespace lockstep
