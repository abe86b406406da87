#include "clients/scenario/runner/scenario_executor.hpp"

#include <fmt/format.h>

#include "clients/scenario/model/scenario_text.hpp"
#include "clients/scenario/runner/step_job.hpp"
#include "clients/session/reports.hpp"
#include "clients/text/format.hpp"
#include "core/kinematics/motors.hpp"

namespace lockstep::scenario {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;
using Step = Asked::Step;

constexpr nanoseconds kPollInterval = 5ms;
constexpr nanoseconds kWaitPatience = 30s;
constexpr nanoseconds kJobPatience = 180s;
constexpr nanoseconds kSettlePatience = 5s;

nanoseconds to_time(double seconds) {
    return std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(seconds));
}

double to_seconds(nanoseconds time) { return static_cast<double>(time.count()) * 1e-9; }

Step::Ending ending_of(JobResult result) {
    switch (result) {
        case JobResult::Done: return Step::DONE;
        case JobResult::Stopped: return Step::STOPPED;
        case JobResult::CutShort: return Step::CUT_SHORT;
        case JobResult::Lost: return Step::LOST;
        default: return Step::FAILED;
    }
}

std::string text_of(const Failure& failure) { return to_text(failure.file, failure.errors); }

/// Whether states of all axes with active processes came since then.
bool receives_all(const Session& session, ProcessSet& processes, nanoseconds since) {
    const std::vector<std::string> motors = motor_names(session.config());
    for (const MotorIndex i : motor_indices(motors.size())) {
        const bool is_received = session.received().motor(i) && session.received().motor(i)->time > since &&
                                 session.state()->state.motors_present.contains(i);
        if (processes.is_active("axis-" + motors[i]) && !is_received) { return false; }
    }
    return true;
}

/// Ignores axes with overdue states.
bool all_present_rest(const Session& session) {
    for (const MotorIndex i : motor_indices(motor_count(session.config()))) {
        if (session.received().motor_present(i) && !session.received().motor(i)->state.at_rest) { return false; }
    }
    return true;
}

Moment moment_of(const Session& session, nanoseconds begun) {
    Moment now{.since_begun_s = to_seconds(monotonic_now() - begun)};
    if (session.state()) {
        now.phase = session.state()->state.phase;
        now.line = session.state()->state.line;
    }
    for (const AxisIndex i : axis_indices(session.config().axes.size())) {
        const auto& axis = session.received().axis(i);
        now.at_mm.push_back(axis ? std::optional(to_mm(session.config().axes[i], axis->state.position.as_steps()))
                                 : std::nullopt);
    }
    return now;
}

}  // namespace

ScenarioExecutor::ScenarioExecutor(const Scenario& scenario, Session& session, ProcessSet& processes, ActExecutor& acts)
    : scenario_(scenario), session_(session), processes_(processes), acts_(acts), notes_(scenario.machine) {}

void ScenarioExecutor::execute() {
    notes_.begin();
    for (const Step& step : scenario_.asked.step()) {
        ++step_;
        execute_step(step);
        if (!notes_.observed().broken.empty()) { return; }
    }
    settle();
}

void ScenarioExecutor::execute_step(const Step& step) {
    if (step.has_wait()) { return execute_wait(step); }
    if (!step.has_act()) { return execute_job(step); }
    notes_.note(text_of(step.act()));
    const auto done = acts_.execute(step.act());
    notes_.add_check(title(step), done ? "done" : done.error(), done.has_value());
}

void ScenarioExecutor::execute_wait(const Step& step) {
    const Asked::Wait& wait = step.wait();
    if (wait.has_phase()) {
        const bool is_there = wait_for(wait.phase());
        if (!is_there) {
            notes_.observed().broken = title(step) + ": not reached, it is " + status_report(session_).phase();
        }
        notes_.note(title(step) + (is_there ? ": it is" : ": not reached"));
    }
    const nanoseconds until = monotonic_now() + to_time(wait.seconds());
    while (monotonic_now() < until) { poll_session(); }
    if (step.has_fault()) { check_found(step); }
}

void ScenarioExecutor::check_found(const Step& step) {
    const auto fault = session_.state() ? fault_of(session_.state()->state, scenario_.machine) : std::nullopt;
    const std::string found = fault ? fault->name() : "none";
    notes_.add_check(title(step) + ": the fault is " + step.fault(), found, found == step.fault());
}

bool ScenarioExecutor::wait_for(Asked::Phase phase) {
    const nanoseconds deadline = monotonic_now() + kWaitPatience;
    const nanoseconds since = monotonic_now();
    const auto is_there = [&] {
        const auto& received = session_.state();
        return received && received->time > since && is_in(phase, received->state.phase) &&
               receives_all(session_, processes_, since);
    };
    while (!is_there() && monotonic_now() < deadline) { poll_session(); }
    return is_there();
}

void ScenarioExecutor::execute_job(const Step& step) {
    notes_.note(text_of(step));
    EventSchedule schedule(step, scenario_.machine.axis_names());
    const auto end = run_to_end(step, schedule);
    if (!end) {
        notes_.observed().broken = title(step) + ": " + end.error();
        return check_left(step, schedule, "the job has not ended");
    }
    notes_.note(text_of(step) + ": " + text_of(end->ending) + (end->fault.empty() ? "" : ", " + end->fault));
    check_left(step, schedule, "the job ended before (" + text_of(end->ending) + ")");
    check_ending(step, *end);
}

std::expected<ScenarioExecutor::Ended, std::string> ScenarioExecutor::run_to_end(const Step& step,
                                                                                 EventSchedule& schedule) {
    auto job = StepJob::prepare(scenario_, step, session_);
    if (!job) { return std::unexpected(text_of(job.error())); }
    for (std::optional<nanoseconds> begun;;) {
        const Term asked = session_.state() ? session_.state()->state.term : Term{};
        const auto reply = job->begin();
        if (!reply) { return std::unexpected(text_of(reply.error())); }
        if (reply->status == ReplyStatus::Refused) { return Ended{Step::REFUSED, std::string(name_of(reply->fault))}; }
        if (!begun) { begun = monotonic_now(); }
        const auto end = watch({reply->job, asked, asked}, *begun, schedule);
        if (!end) { return std::unexpected("it has not ended after " + fixed(to_seconds(kJobPatience), 0) + " s"); }
        if (end->ending != Step::DONE) { return *end; }
        const auto has_more = job->read_on(reply->job, notes_);
        if (!has_more) { return std::unexpected(text_of(has_more.error())); }
        if (!*has_more) { return *end; }
    }
}

std::optional<ScenarioExecutor::Ended> ScenarioExecutor::watch(WatchedJob watched, nanoseconds begun,
                                                               EventSchedule& schedule) {
    while (monotonic_now() - begun < kJobPatience) {
        inject_due(schedule, begun);
        if (const auto end = ended(watched)) { return end; }
        poll_session();
    }
    return std::nullopt;
}

std::optional<ScenarioExecutor::Ended> ScenarioExecutor::ended(WatchedJob& watched) {
    if (session_.is_silent()) {
        return all_present_rest(session_) ? std::optional(Ended{Step::SILENT, ""}) : std::nullopt;
    }
    const MachineState& state = session_.state()->state;
    const JobResult result = lockstep::result_of(state, watched.job, watched.asked, watched.runs_it);
    if (result == JobResult::InProgress) {
        if (state.phase != MachinePhase::Waiting) { watched.runs_it = state.term; }
        return std::nullopt;
    }
    const auto fault = fault_of(state, scenario_.machine);
    return Ended{ending_of(result), fault ? fault->name() : ""};
}

void ScenarioExecutor::inject_due(EventSchedule& schedule, nanoseconds begun) {
    while (const Asked::During* during = schedule.next(moment_of(session_, begun))) {
        const Tick at = notes_.now();
        notes_.note(text_of(*during), at);
        const auto done = acts_.execute(during->act());
        notes_.add_check(text_of(*during), done ? "done at " + fixed(notes_.seconds_at(at), 3) + " s" : done.error(),
                         done.has_value());
        for (const auto& output : during->output()) {
            notes_.observed().outputs.push_back({text_of(during->act()), at, output});
        }
        if (!during->has_rests_within_frames()) { continue; }
        AwaitedRest rest{text_of(during->act()), at, during->rests_within_frames(), {}};
        for (const std::string& motor : motor_names(scenario_.machine)) {
            if (processes_.is_active("axis-" + motor)) { rest.axes.push_back(motor); }
        }
        notes_.observed().rests.push_back(std::move(rest));
    }
}

void ScenarioExecutor::poll_session() {
    undo_due();
    session_.receive(kPollInterval);
}

void ScenarioExecutor::undo_due() {
    while (const auto act = acts_.take_due()) {
        notes_.note(text_of(*act));
        const auto done = acts_.execute(*act);
        if (!done) { notes_.add_check(text_of(*act), done.error(), false); }
    }
}

void ScenarioExecutor::check_left(const Step& step, const EventSchedule& schedule, const std::string& because) {
    for (int i = schedule.done(); i < step.during_size(); ++i) {
        notes_.add_check(text_of(step.during(i)), "never happened: " + because, false);
    }
}

void ScenarioExecutor::check_ending(const Step& step, const Ended& found) {
    const auto with = [](const std::string& fault) { return fault.empty() ? "" : " with " + fault; };
    const bool held = found.ending == step.ends() && (!step.has_fault() || step.fault() == found.fault);
    notes_.add_check(title(step) + ": ends " + text_of(step.ends()) + with(step.fault()),
                     text_of(found.ending) + with(found.fault), held);
}

/// Waits until all acts are undone, and exactly the axes with active processes count as present.
void ScenarioExecutor::settle() {
    const nanoseconds since = monotonic_now();
    const auto is_settled = [&] {
        const std::vector<std::string> motors = motor_names(scenario_.machine);
        for (const MotorIndex i : motor_indices(motors.size())) {
            if (session_.received().motor_present(i) != processes_.is_active("axis-" + motors[i])) { return false; }
        }
        return !acts_.has_more_to_undo();
    };
    while (acts_.has_more_to_undo() || (!is_settled() && monotonic_now() - since < kSettlePatience)) { poll_session(); }
    notes_.observed().status = status_report(session_);
}

std::string ScenarioExecutor::title(const Step& step) const { return fmt::format("step {}, {}", step_, text_of(step)); }

}  // namespace lockstep::scenario
