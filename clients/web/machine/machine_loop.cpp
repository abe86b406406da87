#include "clients/web/machine/machine_loop.hpp"

#include <utility>

#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostActions = 64;  // that wait
constexpr std::size_t kMostTasks = 64;
constexpr nanoseconds kLoop = 10ms;
constexpr nanoseconds kBusyLoop = 5ms;  // while something is under way

Problem too_many() {
    return {.status = 429,
            .code = "too-many-commands",
            .title = "too many commands wait",
            .detail = std::to_string(kMostActions) + " commands wait for the machine",
            .limit = std::to_string(kMostActions),
            .remedy = "wait for their answers"};
}

}  // namespace

MachineLoop::MachineLoop(Session session, Publish publish)
    : session_(std::move(session)),
      jog_(session_),
      publish_(std::move(publish)),
      healths_(session_.config().axes.size()),
      snapshot_(std::make_shared<const Snapshot>(taken())),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

MachineLoop::~MachineLoop() {
    thread_.request_stop();
    thread_.join();
}

void MachineLoop::add(Action action, const Done& done) {
    {
        const std::lock_guard lock(mutex_);
        if (actions_.size() < kMostActions) {
            actions_.push_back(std::move(action));
            return;
        }
    }
    done(std::unexpected(too_many()));
}

void MachineLoop::command(const Command& command, Done done) {
    add([this, command, done] { start(std::make_unique<CommandTask>(command, shown(done)), done); }, done);
}

void MachineLoop::jog(const JogOrder& order, Done done) {
    add([this, order, done] { take_jog(order, done); }, done);
}

void MachineLoop::run(ReadyProgram&& program, Done done) {
    const auto shared = std::make_shared<ReadyProgram>(std::move(program));
    const auto begun = [this, facts = shared->facts](std::uint64_t job) { job_ = OwnJob{job, facts}; };
    add([this, shared, begun, done] { start(std::make_unique<RunTask>(std::move(*shared), begun, shown(done)), done); },
        done);
}

void MachineLoop::change_values(ValuesTask::Change change, Done done) {
    add([this, change, done] { start(std::make_unique<ValuesTask>(change, shown(done)), done); }, done);
}

void MachineLoop::end_stream(const std::string& name) {
    add(
        [this, name] {
            if (guard_.end_stream(name)) { jog_.release(); }
        },
        [](Outcome&&) {});  // the jog then runs out
}

std::shared_ptr<const Snapshot> MachineLoop::snapshot() const {
    const std::lock_guard lock(mutex_);
    return snapshot_;
}

void MachineLoop::work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        const bool is_busy = guard_.is_pressed() || !tasks_.empty();
        jog_.pass(monotonic_now() + (is_busy ? kBusyLoop : kLoop));
        note_healths();
        take_actions();
        follow_jog();
        poll_tasks();
        if (monotonic_now() - published_ < kPublishPeriod) { continue; }
        published_ = monotonic_now();
        show();
        publish_(snapshot());
    }
    jog_.release();
    jog_.pass(monotonic_now() + kLoop);
}

void MachineLoop::show() {
    auto snapshot = std::make_shared<const Snapshot>(taken());
    const std::lock_guard lock(mutex_);
    snapshot_ = std::move(snapshot);
}

Done MachineLoop::shown(const Done& done) {
    return [this, done](Outcome&& outcome) {
        show();
        done(std::move(outcome));
    };
}

void MachineLoop::take_actions() {
    std::deque<Action> actions;
    {
        const std::lock_guard lock(mutex_);
        actions.swap(actions_);
    }
    for (const Action& action : actions) { action(); }
}

/// A program that is being sent, by a task or while it runs, is not replaced by another.
bool MachineLoop::is_sending() const {
    for (const auto& task : tasks_) {
        if (task->sends()) { return true; }
    }
    const ProgramSender* sender = session_.sender();
    const bool is_open = sender != nullptr && !sender->is_done() && !sender->refusal();
    return is_open && job_ && !session_.is_silent() && session_.state()->state.job == job_->number &&
           !session_.state()->state.outcome;
}

void MachineLoop::start(std::unique_ptr<Task> task, const Done& done) {
    if (task->sends() && is_sending()) {
        return done(std::unexpected(refused(FaultCode::Busy, "this server is sending a program")));
    }
    if (tasks_.size() >= kMostTasks) { return done(std::unexpected(too_many())); }
    if (!task->poll(session_, monotonic_now())) { tasks_.push_back(std::move(task)); }
}

void MachineLoop::poll_tasks() {
    auto tasks = std::exchange(tasks_, {});
    for (auto& task : tasks) {
        if (!task->poll(session_, monotonic_now())) { tasks_.push_back(std::move(task)); }
    }
}

void MachineLoop::take_jog(const JogOrder& order, const Done& done) {
    if (auto taken = guard_.take(order, monotonic_now()); !taken) { return done(std::unexpected(taken.error())); }
    if (order.jogs.empty()) {
        if (!guard_.is_pressed()) { jog_.release(); }
        return done(Accepted{.jogging = false});
    }
    jog_.press(order.jogs);
    jogs_waiting_.push_back(done);
}

/// Answers the renewals that the coordinator has answered, and ends the jog that nobody renews.
void MachineLoop::follow_jog() {
    if (guard_.runs_out(monotonic_now())) { jog_.release(); }
    const Reply* reply = jog_.reply();
    const bool is_refused = jog_.is_pressed() && reply != nullptr && reply->status == ReplyStatus::Refused;
    Outcome outcome = Accepted{.jogging = jog_.is_pressed() && !jog_.is_over()};
    if (is_refused) { outcome = std::unexpected(refused(static_cast<FaultCode>(reply->fault), reply->text)); }
    if (jog_.is_pressed() && reply == nullptr) { return; }
    for (const Done& done : std::exchange(jogs_waiting_, {})) { done(Outcome(outcome)); }
    if (!is_refused) { return; }
    guard_.end();
    jog_.release();
}

void MachineLoop::note_healths() {
    for (std::size_t i = 0; i < healths_.size(); ++i) {
        const auto& health = session_.health(i);
        if (!health || (healths_[i] && healths_[i]->value.tick == health->tick)) { continue; }
        healths_[i] = Seen<AxisHealth>{*health, monotonic_now()};
    }
}

Snapshot MachineLoop::taken() const {
    Snapshot snapshot{.time = monotonic_now()};
    if (const auto& state = session_.state()) { snapshot.machine = Seen<MachineState>{state->state, state->time}; }
    snapshot.is_silent = session_.is_silent();
    snapshot.has_standby = session_.has_standby();
    snapshot.config_differs = session_.config_differs();
    for (std::size_t i = 0; i < session_.config().axes.size(); ++i) {
        AxisSnapshot axis{.is_present = session_.axis_present(i), .state = {}, .health = healths_[i]};
        if (const auto& state = session_.axis(i)) { axis.state = Seen<AxisState>{state->state, state->time}; }
        snapshot.axes.push_back(std::move(axis));
    }
    snapshot.values = session_.newest_values();
    snapshot.job = job_;
    return snapshot;
}

}  // namespace lockstep::web
