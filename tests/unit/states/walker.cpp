#include "tests/unit/states/walker.hpp"

#include "core/protocol/names.hpp"
#include "tests/unit/virtual/jogger.hpp"

namespace lockstep {
namespace {

constexpr double kRestWithin_s = 2;  // for a hold, a stop, an emergency stop, a reset
constexpr double kJobWithin_s = 60;  // for homing, and for any job of these tests
constexpr int kRounds = 8;           // of remedies, at most, until a job runs
constexpr std::uint64_t kNotSent = 999;
constexpr Identity kJogger = 60;
constexpr Identity kResumer = 61;
constexpr double kJog_mm = 1;

bool is_begun(CommandKind kind) {
    return kind == CommandKind::Home || kind == CommandKind::Run || kind == CommandKind::Move ||
           kind == CommandKind::MoveOwn || kind == CommandKind::Jog;
}

std::string_view text_of(JobOutcome outcome) {
    switch (outcome) {
        case JobOutcome::Done: return "done";
        case JobOutcome::Stopped: return "stopped";
        case JobOutcome::Failed: break;
    }
    return "failed";
}

}  // namespace

Reply Walker::go(CommandKind kind, double x_mm, double y_mm, double feed_mm_s, bool pauses) {
    std::vector<double> start;
    for (const std::int64_t count : counts()) { start.push_back(static_cast<double>(count) / 100); }
    Program program = program_of({{x_mm, y_mm}}, feed_mm_s, start);
    if (pauses) { program.blocks.insert(program.blocks.begin(), Block{.action = Pause{}}); }
    vm.give_program(++programs_, program);
    return ask(kind, {}, programs_);
}

Reply Walker::jog(Identity client, std::optional<double> distance_mm, double seconds) {
    Jogger jogger(vm, client);
    jogger.press({{.axis = AxisIndex{0}, .speed_mm_s = 20, .distance_mm = distance_mm}});
    const Tick end = vm.now() + Ticks{static_cast<std::int64_t>(seconds * 1e6)};
    while (vm.now() < end && jogger.reply() == nullptr) { pass(vm, {&jogger}, Ticks{500}); }
    if (jogger.reply() == nullptr) { return {.status = ReplyStatus::Refused, .text = "no reply"}; }
    const Reply reply = *jogger.reply();
    if (reply.status == ReplyStatus::Refused) { return reply; }
    const auto goes_on = [&] { return vm.state()->job < reply.job || vm.state()->phase == MachinePhase::Jogging; };
    pass(vm, {&jogger}, Ticks{20'000});  // in a pause the state has the same job before and after
    while (vm.now() < end && goes_on()) { pass(vm, {&jogger}, Ticks{20'000}); }
    return reply;
}

void Walker::inject(VirtualFault fault, double seconds) {
    fault.at = vm.now();
    fault.lasts = Ticks{static_cast<std::int64_t>(seconds * 1e6)};
    vm.schedule(fault);
}

bool Walker::is_settled() const {
    const MachineState& state = *vm.state();
    switch (state.phase) {
        case MachinePhase::Homing:
        case MachinePhase::Jogging:
        case MachinePhase::Running:
        case MachinePhase::Stopping: return false;
        case MachinePhase::Waiting: return state.motors_present != MotorSet::first(vm.machine().axes.size());
        default: return true;
    }
}

/// Waits until the machine is settled, by a state published after the last command.
bool Walker::settles(double seconds) {
    wait(0.01);
    return is_settled() ||
           vm.advance_until([this] { return is_settled(); }, Ticks{static_cast<std::int64_t>(seconds * 1e6)});
}

std::string Walker::state_text() const {
    std::string text(name_of(vm.state()->phase));
    if (vm.state()->fault != FaultCode::None) { text += ": " + std::string(name_of(fault())); }
    return text;
}

/// As a person who confirms the way back.
Reply Walker::resume_and_return() {
    const Command command{.client = kResumer, .sequence = ++resumes_, .kind = CommandKind::Resume, .returns = true};
    const Reply* reply = nullptr;
    for (int tries = 0; tries < 8 && reply == nullptr; ++tries) {
        vm.send(command);
        wait(0.1);
        for (const Reply& one : vm.replies()) {
            if (one.client == kResumer && one.sequence == resumes_) { reply = &one; }
        }
    }
    return reply == nullptr ? Reply{.status = ReplyStatus::Refused, .text = "no reply"} : *reply;
}

Reply Walker::put(const Question& question) {
    if (question.kind == CommandKind::Override) {
        const auto sequence = vm.set_overrides({question.feed_percent, 100});
        const auto answered = [&] { return vm.reply_to(sequence) != nullptr; };
        for (int tries = 0; tries < 4 && !vm.advance_until(answered, Ticks{250'000}); ++tries) { vm.repeat_command(); }
        const Reply* reply = vm.reply_to(sequence);
        return reply == nullptr ? Reply{.status = ReplyStatus::Refused, .text = "no reply"} : *reply;
    }
    if (question.kind == CommandKind::Jog) { return jog(kJogger, kJog_mm, kRestWithin_s); }
    if (question.program == Question::Program::None) { return ask(question.kind); }
    if (question.program == Question::Program::Unknown) { return ask(question.kind, {}, kNotSent); }
    return go(question.kind, 12, 14, 40);
}

Answer Walker::answer_to(const Question& question) {
    const std::uint64_t jobs = vm.state()->job;
    const bool had_job = !vm.state()->outcome && jobs > 0;
    jogged_in_pause_ = vm.state()->pause && vm.state()->phase == MachinePhase::Jogging;
    const Reply reply = put(question);
    EXPECT_NE(reply.text, "no reply") << "it is answered in time";
    if (reply.status == ReplyStatus::Refused) {
        const auto code = reply.fault;
        const FaultText* text = find_fault(code);
        EXPECT_NE(text, nullptr) << reply.text;
        EXPECT_FALSE(reply.text.empty());
        if (text != nullptr) { EXPECT_FALSE(remedy_text(*text).empty()) << text->name; }
        return {"refused: " + std::string(name_of(code)), code};
    }
    expect_effect(question, reply, jobs);
    std::string text = question.kind == CommandKind::Override ? "overrides changed" : state_text();
    const bool ended = vm.state()->outcome && (had_job || vm.state()->job > jobs);
    if (ended) { text += ", job " + std::string(text_of(*vm.state()->outcome)); }
    return {text, {}};
}

void Walker::expect_effect(const Question& question, const Reply& reply, std::uint64_t jobs_before) {
    bool ends_job = question.kind == CommandKind::Stop || question.kind == CommandKind::Reset;
    if (question.kind == CommandKind::Override) {
        wait(0.01);
        EXPECT_EQ(vm.state()->overrides.feed_percent, question.feed_percent);
        return;
    }
    if (question.kind == CommandKind::Resume) {
        wait(0.02);
        EXPECT_TRUE(vm.state()->phase == MachinePhase::Running || vm.state()->outcome) << state_text();
        return;
    }
    if (question.kind == CommandKind::Jog && vm.state()->pause) {
        EXPECT_TRUE(settles(kJobWithin_s)) << state_text();
        EXPECT_EQ(vm.state()->phase, MachinePhase::Paused) << "the job waits as before";
        return;
    }
    EXPECT_TRUE(settles(is_begun(question.kind) ? kJobWithin_s : kRestWithin_s)) << state_text();
    if (is_begun(question.kind)) {
        EXPECT_GT(reply.job, jobs_before);
        EXPECT_TRUE(vm.state()->outcome && vm.state()->job == reply.job) << "it ran to its end: " << state_text();
    }
    if (ends_job && jogged_in_pause_) {
        EXPECT_EQ(vm.state()->phase, MachinePhase::Paused) << "it ends the jog, and the job waits as before";
        ends_job = false;
    }
    if (ends_job) { EXPECT_TRUE(vm.state()->outcome || vm.state()->job == 0) << "no job is left: " << state_text(); }
    if (question.kind == CommandKind::EmergencyStop) { EXPECT_EQ(vm.state()->phase, MachinePhase::Fault); }
    for (const MotorIndex i : motor_indices(vm.axis_states().size())) {
        if (vm.state()->motors_present.contains(i)) { EXPECT_TRUE(vm.axis_states()[i]->at_rest) << "axis " << i; }
    }
}

std::size_t Walker::choices(FaultCode code) {
    const FaultText* text = find_fault(code);
    return text != nullptr && text->remedies.is_choice ? text->remedies.count : 1;
}

/// Does the repairs that a person makes by hand: faults end, and missing parts are sent.
void Walker::repair() {
    if (std::exchange(is_program_delayed_, false)) { vm.give_program(kNotSent, program_of({{40, 40}, {20, 20}}, 20)); }
    (void)vm.advance_until([this] { return !vm.faults_pending(); }, Ticks{120'000'000});
    wait(0.2);
}

void Walker::carry_out(Remedy remedy) {
    const auto must_be_accepted = [this](CommandKind kind) {
        const Reply reply = ask(kind);
        EXPECT_EQ(reply.status, ReplyStatus::Accepted) << name_of(kind) << " in " << state_text() << ": " << reply.text;
        EXPECT_TRUE(settles(kJobWithin_s)) << "after " << name_of(kind) << ": " << state_text();
    };
    switch (remedy) {
        case Remedy::Wait: EXPECT_TRUE(settles(kJobWithin_s)) << state_text(); break;
        case Remedy::Home: must_be_accepted(CommandKind::Home); break;
        case Remedy::Resume:
            EXPECT_EQ(resume_and_return().status, ReplyStatus::Accepted) << state_text();
            EXPECT_TRUE(settles(kJobWithin_s)) << state_text();
            break;
        case Remedy::Stop: must_be_accepted(CommandKind::Stop); break;
        case Remedy::Reset: must_be_accepted(CommandKind::Reset); break;
        case Remedy::Status:
        case Remedy::Again:
        case Remedy::Timing:
        case Remedy::Incident:
        case Remedy::RunRest:
        case Remedy::Take: break;
    }
}

void Walker::follow(FaultCode code, std::size_t choice) {
    const FaultText* text = find_fault(code);
    ASSERT_NE(text, nullptr);
    if (!text->by_hand.empty()) { repair(); }
    const auto steps = text->remedies.list();
    for (const Remedy step : text->remedies.is_choice ? steps.subspan(choice, 1) : steps) { carry_out(step); }
}

bool Walker::recovers() {
    for (int round = 0; round < kRounds; ++round) {
        EXPECT_TRUE(settles(kJobWithin_s)) << state_text();
        if (vm.state()->phase == MachinePhase::Fault) {
            follow(fault());
            continue;
        }
        const Reply reply = go(CommandKind::Run, 20, 30, 80);
        if (reply.status == ReplyStatus::Refused) {
            follow(reply.fault);
            continue;
        }
        EXPECT_TRUE(settles(kJobWithin_s)) << state_text();
        if (vm.state()->phase == MachinePhase::Idle && vm.state()->outcome == JobOutcome::Done) { return true; }
    }
    return false;
}

}  // namespace lockstep
