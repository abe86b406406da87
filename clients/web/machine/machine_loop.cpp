#include "clients/web/machine/machine_loop.hpp"

#include <fmt/format.h>

#include <utility>

#include "clients/session/control/open_probe.hpp"
#include "core/protocol/needs_lease.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;

constexpr nanoseconds kLoop = 10ms;
constexpr nanoseconds kBusyLoop = 5ms;  // while something is under way

Problem too_many() {
    return {.status = 429,
            .code = "too-many-commands",
            .title = "too many commands wait",
            .detail = fmt::format("{} commands wait for the machine", ActionQueue::kMostActions),
            .limit = std::to_string(ActionQueue::kMostActions),
            .remedy = "wait for their answers"};
}

/// Several touches begin with an open probe. A single one may begin with a closed one, to move off.
std::optional<Problem> closed_probe(const Session& session, const MeasurePlan& plan) {
    if (plan.options() == nullptr) { return std::nullopt; }
    const auto open = check_open(session, plan.program.probe);
    if (open) { return std::nullopt; }
    return refused(FaultCode::ProbeTouchedEarly, open.error().errors.front().message);
}

}  // namespace

MachineLoop::MachineLoop(Session session, const std::string& writer, Publish publish)
    : session_(std::move(session)),
      lease_(session_, writer),
      jog_(session_),
      publish_(std::move(publish)),
      snapshots_(session_),
      snapshot_(std::make_shared<const Snapshot>(snapshots_.take())),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

MachineLoop::~MachineLoop() {
    thread_.request_stop();
    thread_.join();
}

void MachineLoop::add(ActionQueue::Action action, const Done& done, bool is_stop) {
    if (!actions_.add(std::move(action), is_stop)) { done(std::unexpected(too_many())); }
}

void MachineLoop::command(const Command& command, Done done) {
    add([this, command, done] { start(std::make_unique<CommandTask>(command, shown(done)), done); }, done,
        !needs_lease(command));
}

void MachineLoop::jog(const JogOrder& order, Done done) {
    add([this, order, done] { jog_.take(order, done, monotonic_now()); }, done);
}

void MachineLoop::run(ReadyProgram&& program, Done done) {
    const auto shared = std::make_shared<ReadyProgram>(std::move(program));
    add([this, shared, done] { run_first(*shared, done); }, done);
}

void MachineLoop::run_first(const ReadyProgram& program, const Done& done) {
    if (!program.measures) { return run_task(program, done); }
    if (const auto closed = closed_probe(session_, *program.measures)) { return done(std::unexpected(*closed)); }
    const auto noted = [this, plan = program.measures, done](Outcome&& outcome) {
        if (outcome) { measuring_.begin(plan); }
        done(std::move(outcome));
    };
    run_task(program, noted);
}

void MachineLoop::run_task(const ReadyProgram& program, const Done& done) {
    const auto begun = [this, program](std::uint64_t job) {
        job_ = OwnJob{job, program.facts};
        measuring_.note_begin(program.measures.get());
        if (program.stream || program.measures) { probing_.emplace(program, job); }
    };
    start(std::make_unique<RunTask>(ReadyProgram(program), begun, shown(done)), done);
}

/// Nobody waits for the answer to a next part: the machine's state shows the job, and the measurement.
void MachineLoop::run_next_part() {
    if (!probing_) { return; }
    const ProbingRun::State state = probing_->poll(session_);
    if (state == ProbingRun::State::Runs) { return; }
    const ProbingRun run = *std::exchange(probing_, std::nullopt);
    const bool measures = run.next().measures != nullptr;
    if (measures) { measuring_.note(run, session_.config()); }
    if (state != ProbingRun::State::Ready) { return; }
    run_task(run.next(), [this, measures](Outcome&& outcome) {
        if (measures && !outcome) { measuring_.fail(outcome.error()); }
    });
}

void MachineLoop::change_values(ValuesTask::Change change, Done done) {
    add([this, change, done] { start(std::make_unique<ValuesTask>(change, shown(done)), done); }, done);
}

void MachineLoop::take_lease(Done done) {
    add([this, done] { start(std::make_unique<LeaseTask>(true, shown(done)), done); }, done);
}

void MachineLoop::give_lease(Done done) {
    const auto give = [this, done] {
        lease_.give();
        start(std::make_unique<LeaseTask>(false, shown(done)), done);
    };
    add(give, done);
}

void MachineLoop::end_stream(const std::string& name) {
    add([this, name] { jog_.end_stream(name); }, [](Outcome&&) {});  // if too many actions wait, the jog runs out
}

std::shared_ptr<const Snapshot> MachineLoop::snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_;
}

void MachineLoop::work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        const bool is_busy = jog_.is_pressed() || !tasks_.is_empty();
        jog_.pass(monotonic_now() + (is_busy ? kBusyLoop : kLoop));
        lease_.see();
        snapshots_.note_healths();
        for (const ActionQueue::Action& action : actions_.take()) { action(); }
        jog_.follow(lease_, monotonic_now());
        tasks_.poll(session_, lease_);
        run_next_part();
        lease_.use({.wants = jog_.is_pressed() || tasks_.wants_lease(),
                    .takes_over = tasks_.takes_lease(),
                    .has_work = has_work()});
        if (monotonic_now() - published_ < kPublishPeriod) { continue; }
        published_ = monotonic_now();
        show();
        publish_(snapshot());
    }
    jog_.release();
    jog_.pass(monotonic_now() + kLoop);
    lease_.end();
}

void MachineLoop::show() {
    auto snapshot = std::make_shared<Snapshot>(snapshots_.take());
    snapshot->job = job_;
    snapshot->measurement = measuring_.newest();
    snapshot->writer = lease_.writer();
    const std::lock_guard lock(mutex_);
    snapshot_ = std::move(snapshot);
}

Done MachineLoop::shown(const Done& done) {
    return [this, done](Outcome&& outcome) {
        show();
        done(std::move(outcome));
    };
}

bool MachineLoop::is_own_job() const {
    return job_ && !session_.is_silent() && session_.state()->state.job == job_->number &&
           !session_.state()->state.outcome;
}

/// A held job does not count: another person may continue it.
bool MachineLoop::has_work() const {
    if (jog_.is_pressed() || !tasks_.is_empty()) { return true; }
    if (!is_own_job()) { return probing_.has_value(); }
    const MachinePhase phase = session_.state()->state.phase;
    return phase != MachinePhase::Holding && phase != MachinePhase::Paused;
}

/// True while a program is being sent, by a task or while it runs. Another program may not replace it.
bool MachineLoop::is_sending() const {
    if (tasks_.sends()) { return true; }
    const ProgramSender* sender = session_.upload().sender();
    return sender != nullptr && !sender->is_done() && !sender->refusal() && is_own_job();
}

void MachineLoop::start(std::unique_ptr<Task> task, const Done& done) {
    if (task->sends() && is_sending()) {
        return done(std::unexpected(refused(FaultCode::Busy, "this server is sending a program")));
    }
    if (tasks_.is_full(task->lease() == Task::Lease::NotNeeded)) { return done(std::unexpected(too_many())); }
    tasks_.add(std::move(task));
}

}  // namespace lockstep::web
