#include "clients/scenario/runner/step_job.hpp"

#include <utility>

#include "clients/session/control/probe_touch.hpp"
#include "clients/session/control/program_parts.hpp"
#include "clients/session/job_plan.hpp"
#include "clients/session/move_program.hpp"
#include "clients/session/waits.hpp"

namespace lockstep::scenario {

std::expected<StepJob, Failure> StepJob::prepare(const Scenario& scenario, const Asked::Step& step, Session& session) {
    const CommandKind kind = step.has_home()  ? CommandKind::Home
                             : step.has_run() ? CommandKind::Run
                                              : CommandKind::Move;
    StepJob job(session, {.kind = kind});
    for (const std::string& name : step.home().axis()) {
        job.command_.axes.insert(find_axis(scenario.machine, name).value());
    }
    std::expected<void, Failure> read;
    if (step.has_run()) { read = job.read_run(scenario, step.run()); }
    if (step.has_move()) { read = job.read_move(scenario, step.move()); }
    return read ? std::expected<StepJob, Failure>(std::move(job)) : std::unexpected(read.error());
}

std::expected<void, Failure> StepJob::read_run(const Scenario& scenario, const Asked::Run& run) {
    const auto start_mm = start_places(session_);
    if (!start_mm) { return std::unexpected(start_mm.error()); }
    const auto values = await_values(session_);
    if (!values) { return std::unexpected(values.error()); }
    const auto program = program_of(run, scenario.folder(), scenario.machine, *start_mm, values->values);
    if (!program) { return std::unexpected(bad_file("the program", program.error())); }
    run_.emplace(LineReader::of_text(program->text), program->setup, values->revision);
    const auto read = run_->read_first();
    return read ? std::expected<void, Failure>{} : std::unexpected(bad_file("the program", read.error()));
}

std::expected<void, Failure> StepJob::read_move(const Scenario& scenario, const Asked::Move& move) {
    const auto start_mm = start_places(session_);
    if (!start_mm) { return std::unexpected(start_mm.error()); }
    MoveOptions options{.targets = {move.to().begin(), move.to().end()}};
    if (move.has_feed_mm_min()) { options.feed_mm_min = move.feed_mm_min(); }
    auto program = move_program(scenario.machine, *start_mm, options);
    if (!program) { return std::unexpected(bad_input(program.error())); }
    move_ = *std::move(program);
    return {};
}

std::expected<std::uint64_t, Failure> StepJob::send() {
    return run_ ? send_part(session_, *run_) : send_program(session_, *move_);
}

std::expected<Reply, Failure> StepJob::begin() {
    if (run_ || move_) {
        const auto sent = send();
        if (!sent) { return std::unexpected(sent.error()); }
        command_.program = *sent;
    }
    return send_command(session_, command_);
}

std::expected<bool, Failure> StepJob::read_on(std::uint64_t job, RunNotes& notes) {
    if (!run_) { return false; }
    if (!run_->awaits_touch()) {
        const auto kept = await_kept(session_, *run_);
        return kept ? std::expected<bool, Failure>(false) : std::unexpected(kept.error());
    }
    const auto touch = touch_of(session_, job);
    if (!touch) { return std::unexpected(touch.error()); }
    notes.note(lockstep::text_of(probe_report(session_.config(), *touch)));
    const auto read = read_next_part(session_, *run_, *touch);
    return read ? std::expected<bool, Failure>(!run_->is_empty()) : std::unexpected(read.error());
}

}  // namespace lockstep::scenario
