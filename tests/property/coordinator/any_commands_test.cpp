// A coordinator, alone or with a standby, publishes, orders and answers what was recorded, whatever clients ask in
// whatever order. To write the files: LOCKSTEP_WRITE_HASHES=1 build/bin/property_coordinator
// --gtest_filter='*StayAsRecorded'
#include <memory>
#include <random>

#include "core/coordinator/coordinator.hpp"
#include "core/methods/paper_steps.hpp"
#include "tests/property/coordinator/fake_axes.hpp"
#include "tests/property/recorded_hashes.hpp"
#include "tests/simulation/simtest/record/publication.hpp"

namespace lockstep {
namespace {

constexpr std::uint32_t kMachines = 40;
constexpr Slot kFirst = 1000;
constexpr Slot kSlots = 2500;

MachineConfig draw_machine(std::mt19937_64& random) {
    MachineConfig machine{.name = "drawn"};
    machine.timing = {
        .slot_us = 1000, .stall_slots = 1, .freshness_slots = 2, .send_ahead_slots = 12, .frame_slots = 5};
    const std::size_t axes = 1 + random() % 3;
    for (std::size_t i = 0; i < axes; ++i) {
        machine.axes.push_back({.name = std::string(1, "XYZ"[i]),
                                .steps_per_mm = 100,
                                .start_velocity_mm_s = 20,
                                .max_velocity_mm_s = 50,
                                .max_accel_mm_s2 = 1000,
                                .max_decel_mm_s2 = 1000,
                                .position_min_mm = -10,
                                .position_max_mm = 10});
        machine.axes.back().homing.sequence = static_cast<int>(random() % 2);
        if (random() % 2 == 0) { machine.axes.back().unhomed_jog_mm_s = 5; }
    }
    if (axes > 1 && random() % 4 == 0) { machine.coordination = StepMethod::Lai; }
    if (random() % 2 == 0) { machine.unattended_job = UnattendedJob::IsHeld; }
    return machine;
}

/// Coordinators of a machine, with clients that ask anything at any time. Of two, one stands by, and each sometimes
/// ends and is started again.
class Asked {
public:
    Asked(std::uint32_t number, std::size_t coordinators)
        : random_(number), machine_(draw_machine(random_)), axes_(machine_.axes.size(), number) {
        processes_.resize(coordinators);
        for (std::size_t i = 0; i < coordinators; ++i) { start(i, kFirst + static_cast<Slot>(i)); }
    }

    std::string hash() {
        for (Slot now = kFirst; now < kFirst + kSlots; ++now) { slot(now); }
        return std::to_string(published_.value());
    }

private:
    struct Process {
        std::unique_ptr<Coordinator> coordinator;
        MachineState state;  // the newest
    };

    bool has_standby() const { return processes_.size() > 1; }
    void start(std::size_t i, Slot now) {
        const auto standby =
            has_standby() ? std::optional(one_of(4) ? OnTakeover::Stop : OnTakeover::Continue) : std::nullopt;
        processes_[i].coordinator = std::make_unique<Coordinator>(
            machine_, static_cast<Identity>(now * FakeAxes::kSlot), 1, methods::begin_steps, standby);
    }
    /// The process that owns the machine by the highest term.
    const Coordinator& owner() const {
        const Coordinator* owner = processes_.front().coordinator.get();
        for (const Process& process : processes_) {
            const Coordinator& one = *process.coordinator;
            if (one.owns_machine() && (!owner->owns_machine() || one.term() > owner->term())) { owner = &one; }
        }
        return *owner;
    }

    bool one_of(std::uint64_t n) { return random_() % n == 0; }
    double place() { return static_cast<double>(random_() % 2100) / 100 - 10.5; }

    Block draw_block(std::int32_t line) {
        const std::uint64_t kind = random_() % 12;
        if (kind == 0) { return {line, Dwell{static_cast<double>(random_() % 10) / 50}}; }
        if (kind == 1) { return {line, Pause{.reason = static_cast<PauseReason>(random_() % 3)}}; }
        if (kind == 2) { return {line, Settle{}}; }
        if (kind == 3) { return {line, ProgramEvent{ProgramEvent::Kind::SpindleForward, 0, 1000}}; }
        ProgramMove move{.target_mm = {}, .feed_mm_s = static_cast<double>(1 + random_() % 60), .rapid = one_of(4)};
        for (std::size_t i = 0; i < machine_.axes.size(); ++i) { move.target_mm.push_back(place() / 4); }
        move.mode = static_cast<PathMode>(random_() % 3);
        move.is_feed_fixed = one_of(5);
        return {line, move};
    }
    Program draw_program() {
        Program program{.name = "drawn", .axes = machine_.axis_names()};
        for (const AxisIndex i : axis_indices(machine_.axes.size())) {
            const double start_mm = static_cast<double>(axes_.count(i)) / machine_.axes[i].steps_per_mm;
            program.start_mm.push_back(one_of(30) ? 1 : start_mm);
        }
        const std::int32_t blocks = 1 + static_cast<std::int32_t>(random_() % 8);
        for (std::int32_t line = 1; line <= blocks; ++line) { program.blocks.push_back(draw_block(line)); }
        return program;
    }

    /// A command that is useful in this phase, or sometimes any command.
    CommandKind draw_kind() {
        using enum CommandKind;
        if (owner().phase() == MachinePhase::Fault && !one_of(3)) { return Reset; }
        if (!axes_.are_homed() && !one_of(3)) { return Home; }
        constexpr std::array kKinds{Run,  Run,    Run,  Run,      Run,      Run,  MoveOwn, MoveOwn, Jog,   Jog, Jog,
                                    Hold, Resume, Stop, Override, Override, Move, Resume,  Hold,    Reset, Home};
        if (one_of(60)) { return EmergencyStop; }
        if (one_of(20)) { return one_of(2) ? TakeLease : GiveLease; }
        return kKinds[random_() % kKinds.size()];
    }
    Command draw_command() {
        Command command{.client = 1 + random_() % 2, .sequence = ++sequence_, .kind = draw_kind()};
        command.axes = AxisSet::of_bits(one_of(5) ? random_() % 8 : 0);
        command.program = one_of(20) ? 1 : sequence_;
        const Program program = draw_program();
        for (const Process& process : processes_) { process.coordinator->programs().accept(sequence_, program); }
        if (one_of(3)) { command.ticks = Ticks{static_cast<std::int64_t>(random_() % 3'000'000)}; }
        if (one_of(2)) { command.feed_percent = static_cast<int>(5 + random_() % 200); }
        if (one_of(2)) { command.rapid_percent = static_cast<int>(5 + random_() % 100); }
        for (const AxisIndex i : axis_indices(machine_.axes.size())) {
            if (one_of(2)) { command.jogs.push_back({i, place() * 6, one_of(2) ? std::optional(2.0) : std::nullopt}); }
        }
        command.writer = {.id = one_of(20) ? 2U : 1U, .name = "anna", .host = "bench"};
        command.takes_over = one_of(3);
        command.returns = one_of(3);
        return command;
    }
    /// Now and then a client repeats a command.
    std::vector<Command> commands() {
        constexpr std::uint64_t kOnceIn = 40;
        if (one_of(kOnceIn)) {
            last_ = draw_command();
            return {last_};
        }
        return last_.sequence != 0 && one_of(8) ? std::vector{last_} : std::vector<Command>{};
    }
    /// Sometimes another coordinator is received: one that stands by, or one that claims the machine.
    std::vector<MachineState> others(Slot now) {
        constexpr std::uint64_t kOnceIn = 700;
        if (!one_of(kOnceIn)) { return {}; }
        MachineState other{.term = {1 + random_() % 2'000'000, 999}, .stamp = now - static_cast<Slot>(random_() % 3)};
        other.phase = one_of(2) ? MachinePhase::Standby : MachinePhase::Idle;
        return {other};
    }

    void slot(Slot now) {
        const auto commanded = commands();
        const auto heard = others(now);
        const auto states = axes_.states(now, owner().owns_machine() ? owner().term() : Term{});
        if (has_standby() && one_of(owner().activity().has_job() ? 100 : 900)) {
            start(random_() % processes_.size(), now);
        }
        for (std::size_t i = 0; i < processes_.size(); ++i) {
            std::vector<MachineState> received = heard;
            if (has_standby()) { received.push_back(processes_[1 - i].state); }
            step(i, {Tick{now * FakeAxes::kSlot}, states, received, commanded, {}});
        }
    }
    void step(std::size_t i, const CoordinatorInputs& inputs) {
        const CoordinatorOutputs& out = processes_[i].coordinator->step(inputs);
        published_.on_coordinator(i, inputs.now, out);
        for (const Frame& frame : out.frames) { axes_.take(frame); }
        for (const AxisCommand& order : out.axis_commands) { axes_.take(order, inputs.now.value / FakeAxes::kSlot); }
        if (!out.state) { return; }
        processes_[i].state = *out.state;
        if (out.state->veto) { axes_.take_veto(out.state->veto); }
    }

    std::mt19937_64 random_;
    MachineConfig machine_;
    FakeAxes axes_;
    std::vector<Process> processes_;
    simtest::PublicationHash published_;
    Command last_;
    std::uint64_t sequence_ = 0;
};

TEST(AnswersToAnyCommands, StayAsRecorded) {
    expect_recorded("tests/property/coordinator/any_commands.txt", kMachines,
                    [](std::uint32_t number) { return Asked(number, 1).hash(); });
}
TEST(TakeoversDuringAnyCommands, StayAsRecorded) {
    expect_recorded("tests/property/coordinator/any_takeovers.txt", kMachines,
                    [](std::uint32_t number) { return Asked(number, 2).hash(); });
}

}  // namespace
}  // namespace lockstep
