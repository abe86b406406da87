#include "clients/web/machine/machine_loop.hpp"

#include <fmt/format.h>

#include <utility>

#include "core/protocol/needs_lease.hpp"
#include "services/runtime/clock.hpp"

namespace lockstep::web {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kMostActions = 64;  // that wait
constexpr std::size_t kMostStops = 16;    // that may wait in addition
constexpr nanoseconds kLoop = 10ms;
constexpr nanoseconds kBusyLoop = 5ms;  // while something is under way

Problem too_many() {
    return {.status = 429,
            .code = "too-many-commands",
            .title = "too many commands wait",
            .detail = fmt::format("{} commands wait for the machine", kMostActions),
            .limit = std::to_string(kMostActions),
            .remedy = "wait for their answers"};
}

/// Nullopt unless all motors rest, and no homing brings them together.
std::optional<MotorApart> motor_apart(const Session& session) {
    const Kinematics& kinematics = session.kinematics();
    if (kinematics.is_direct() || !session.state() || session.state()->state.phase == MachinePhase::Homing) {
        return {};
    }
    MotorCounts counts;
    for (std::size_t m = 0; m < kinematics.motors().size(); ++m) {
        const auto& motor = session.motor(m);
        if (!motor || !motor->state.at_rest) { return {}; }
        counts.steps.append(motor->state.position.count());
    }
    const auto astray = kinematics.astray(counts);
    return astray ? std::optional(MotorApart{kinematics.motors()[astray->motor].name, astray->off_mm}) : std::nullopt;
}

}  // namespace

MachineLoop::MachineLoop(Session session, const std::string& writer, Publish publish)
    : session_(std::move(session)),
      lease_(session_, writer),
      jog_(session_),
      publish_(std::move(publish)),
      healths_(session_.kinematics().motors().size()),
      snapshot_(std::make_shared<const Snapshot>(taken())),
      thread_([this](const std::stop_token& stop) { work(stop); }) {}

MachineLoop::~MachineLoop() {
    thread_.request_stop();
    thread_.join();
}

void MachineLoop::add(Action action, const Done& done, bool is_stop) {
    {
        const std::lock_guard lock(mutex_);
        if (actions_.size() < kMostActions + (is_stop ? kMostStops : 0)) {
            actions_.push_back(std::move(action));
            return;
        }
    }
    done(std::unexpected(too_many()));
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
    add([this, shared, done] { run_task(*shared, done); }, done);
}

void MachineLoop::run_task(const ReadyProgram& program, const Done& done) {
    const auto begun = [this, program](std::uint64_t job) {
        job_ = OwnJob{job, program.facts};
        if (program.stream) { probing_.emplace(program, job); }
    };
    start(std::make_unique<RunTask>(ReadyProgram(program), begun, shown(done)), done);
}

/// Nobody waits for the answer to a next part: the machine's state shows the job.
void MachineLoop::run_next_part() {
    if (!probing_) { return; }
    const ProbingRun::State state = probing_->poll(session_);
    if (state == ProbingRun::State::Runs) { return; }
    const ReadyProgram next = probing_->next();
    probing_.reset();
    if (state == ProbingRun::State::Ready) {
        run_task(next, [](Outcome&&) {});
    }
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
        note_healths();
        take_actions();
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
    const ProgramSender* sender = session_.sender();
    return sender != nullptr && !sender->is_done() && !sender->refusal() && is_own_job();
}

void MachineLoop::start(std::unique_ptr<Task> task, const Done& done) {
    if (task->sends() && is_sending()) {
        return done(std::unexpected(refused(FaultCode::Busy, "this server is sending a program")));
    }
    if (tasks_.is_full(task->lease() == Task::Lease::NotNeeded)) { return done(std::unexpected(too_many())); }
    tasks_.add(std::move(task));
}

void MachineLoop::note_healths() {
    for (std::size_t i = 0; i < healths_.size(); ++i) {
        const auto& health = session_.health(i);
        if (!health || (healths_[i] && healths_[i]->value.tick == health->tick)) { continue; }
        healths_[i] = Seen<AxisHealth>{*health, monotonic_now()};
    }
}

AxisSnapshot MachineLoop::taken_axis(std::size_t i) const {
    const auto own = session_.kinematics().own_motor(i);
    AxisSnapshot axis{.is_present = session_.axis_present(i),
                      .is_process = own.has_value(),
                      .steps_per_tick = session_.axis_speed(i),
                      .state = {},
                      .health = {}};
    if (own) { axis.health = healths_[*own]; }
    if (const auto& state = session_.axis(i)) { axis.state = Seen<AxisState>{state->state, state->time}; }
    return axis;
}

/// Those that are not the only motor of an axis.
std::vector<MotorSnapshot> MachineLoop::taken_motors() const {
    const Kinematics& kinematics = session_.kinematics();
    std::vector<MotorSnapshot> motors;
    for (std::size_t m = 0; m < kinematics.motors().size(); ++m) {
        const MotorConfig& config = kinematics.motors()[m];
        if (config.axis && kinematics.own_motor(*config.axis) == m) { continue; }
        MotorSnapshot motor{.name = config.name,
                            .is_board = config.is_board(),
                            .axes = kinematics.names_of_axes(kinematics.axes_of_motor(m)),
                            .steps_per_mm = config.steps_per_mm,
                            .seen = {.is_present = session_.motor_present(m), .state = {}, .health = healths_[m]}};
        if (const auto& state = session_.motor(m)) {
            motor.seen.steps_per_tick = state->state.velocity.steps_per_tick();
            motor.seen.state = Seen<AxisState>{state->state, state->time};
        }
        motors.push_back(std::move(motor));
    }
    return motors;
}

Snapshot MachineLoop::taken() const {
    Snapshot snapshot{.time = monotonic_now()};
    if (const auto& state = session_.state()) { snapshot.machine = Seen<MachineState>{state->state, state->time}; }
    snapshot.is_silent = session_.is_silent();
    snapshot.has_standby = session_.has_standby();
    snapshot.config_differs = session_.config_differs();
    for (std::size_t i = 0; i < session_.config().axes.size(); ++i) { snapshot.axes.push_back(taken_axis(i)); }
    snapshot.motors = taken_motors();
    snapshot.apart = motor_apart(session_);
    snapshot.values = session_.newest_values();
    snapshot.values_unsaved_since = session_.values_unsaved_since();
    snapshot.job = job_;
    snapshot.writer = lease_.writer();
    return snapshot;
}

}  // namespace lockstep::web
