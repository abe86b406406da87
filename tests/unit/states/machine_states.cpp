#include "tests/unit/states/machine_states.hpp"

#include "tests/unit/virtual/true_clocks.hpp"

namespace lockstep {
namespace {

using Kind = VirtualFault::Kind;

constexpr std::size_t kX = 0;
constexpr std::size_t kY = 1;
constexpr std::size_t kCoordinator = 2;

VirtualOptions on_one_clock() { return {.machine = small_machine()}; }

VirtualOptions with_standby() { return {.machine = small_machine(), .coordinators = 2}; }

VirtualOptions with_standby_that_goes_on() {
    return {.machine = small_machine(), .on_takeover = OnTakeover::Continue, .coordinators = 2};
}

VirtualOptions on_clocks_apart() { return test::by_clocks_apart(small_machine()); }

void expect_phase(Walker& m, MachinePhase phase, double seconds = 3) {
    ASSERT_TRUE(m.reaches(phase, seconds)) << m.state_text();
}

void expect_fault(Walker& m, FaultCode code) {
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Fault);
    EXPECT_EQ(m.vm.state()->fault, code) << m.state_text();
}

void ask_for(Walker& m, CommandKind kind) { ASSERT_EQ(m.ask(kind).status, ReplyStatus::Accepted); }

void unhomed(Walker& m) { expect_phase(m, MachinePhase::Idle); }

void without_an_axis(Walker& m) {
    m.inject({.kind = Kind::Crash, .process = kY}, 3);
    m.wait(0.5);
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Waiting);
}

void homing(Walker& m) {
    unhomed(m);
    ask_for(m, CommandKind::Home);
    m.wait(0.2);
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Homing);
}

void homing_that_stops(Walker& m) {
    homing(m);
    ask_for(m, CommandKind::Stop);
}

void idle(Walker& m) { m.home(); }

void running(Walker& m) {
    m.home();
    ASSERT_EQ(m.go(CommandKind::Run, 85, 45, 20).status, ReplyStatus::Accepted);
    m.wait(0.5);
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Running);
}

void stopping_to_hold(Walker& m) {
    running(m);
    ask_for(m, CommandKind::Hold);
    EXPECT_NE(m.vm.state()->phase, MachinePhase::Holding);
}

void stopping(Walker& m) {
    running(m);
    ask_for(m, CommandKind::Stop);
    EXPECT_NE(m.vm.state()->phase, MachinePhase::Idle);
}

void holding(Walker& m) {
    stopping_to_hold(m);
    expect_phase(m, MachinePhase::Holding);
}

void resuming(Walker& m) {
    holding(m);
    ask_for(m, CommandKind::Resume);
}

void paused(Walker& m) {
    m.home();
    ASSERT_EQ(m.go(CommandKind::Run, 85, 45, 20, true).status, ReplyStatus::Accepted);
    expect_phase(m, MachinePhase::Paused);
}

void paused_away(Walker& m) {
    paused(m);
    EXPECT_EQ(m.jog(7, 3, 2).status, ReplyStatus::Accepted);
    expect_phase(m, MachinePhase::Paused);
}

void jogging_in_a_pause(Walker& m) {
    paused(m);
    EXPECT_EQ(m.jog(7, {}, 0.4).status, ReplyStatus::Accepted);
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Jogging);
}

void returning(Walker& m) {
    paused(m);
    EXPECT_EQ(m.jog(7, 60, 9).status, ReplyStatus::Accepted);
    EXPECT_EQ(m.resume_and_return().status, ReplyStatus::Accepted);
    m.wait(0.1);
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Running);
}

void own_move(Walker& m) {
    m.home();
    ASSERT_EQ(m.go(CommandKind::MoveOwn, 95, 80, 0).status, ReplyStatus::Accepted);
    m.wait(0.4);
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Running);
}

void own_move_that_stops(Walker& m) {
    own_move(m);
    ask_for(m, CommandKind::Stop);
}

/// A client holds the key of a jog until the command is sent, and then sends nothing more.
void jogging(Walker& m) {
    m.home();
    ASSERT_EQ(m.jog(7, std::nullopt, 0.4).status, ReplyStatus::Accepted);
    EXPECT_EQ(m.vm.state()->phase, MachinePhase::Jogging);
}

void jogging_that_stops(Walker& m) {
    jogging(m);
    ask_for(m, CommandKind::Stop);
}

void limit_hit_in_a_jog(Walker& m) {
    jogging(m);
    m.vm.device(kX).plant().push(9'000);
    (void)m.jog(7, std::nullopt, 0.1);
    expect_phase(m, MachinePhase::Fault);
}

void limit_hit(Walker& m) {
    running(m);
    m.vm.device(kX).plant().push(9'000);
    expect_phase(m, MachinePhase::Fault);
}

void stopping_at_a_limit(Walker& m) {
    running(m);
    m.vm.device(kX).plant().push(9'000);
    expect_phase(m, MachinePhase::Stopping);
}

void limit_hit_in_own_move(Walker& m) {
    own_move(m);
    m.vm.device(kX).plant().push(9'000);
    expect_phase(m, MachinePhase::Fault);
}

void limit_hit_and_reset(Walker& m) {
    limit_hit(m);
    ask_for(m, CommandKind::Reset);
    expect_phase(m, MachinePhase::Idle);
}

void steps_lost(Walker& m) {
    running(m);
    m.vm.device(kY).plant().push(-20);
    expect_phase(m, MachinePhase::Fault);
}

void emergency_stopped(Walker& m) {
    running(m);
    ask_for(m, CommandKind::EmergencyStop);
    expect_phase(m, MachinePhase::Fault);
}

void emergency_stopped_in_homing(Walker& m) {
    homing(m);
    ask_for(m, CommandKind::EmergencyStop);
    expect_phase(m, MachinePhase::Fault);
}

void emergency_stopped_at_rest(Walker& m) {
    m.home();
    ask_for(m, CommandKind::EmergencyStop);
    expect_phase(m, MachinePhase::Fault);
}

void emergency_stopped_and_reset(Walker& m) {
    emergency_stopped(m);
    ask_for(m, CommandKind::Reset);
    expect_phase(m, MachinePhase::Idle);
}

void axis_lost(Walker& m) {
    running(m);
    m.inject({.kind = Kind::Crash, .process = kY}, 5);
    expect_phase(m, MachinePhase::Fault);
}

void axis_lost_and_back(Walker& m) {
    running(m);
    m.inject({.kind = Kind::Crash, .process = kY}, 0.5);
    expect_phase(m, MachinePhase::Fault);
    m.wait(1);
}

void axis_lost_in_homing(Walker& m) {
    homing(m);
    m.inject({.kind = Kind::Crash, .process = kY}, 5);
    expect_phase(m, MachinePhase::Fault);
}

void axis_lost_at_rest_and_back(Walker& m) {
    m.home();
    m.inject({.kind = Kind::Crash, .process = kY}, 0.5);
    m.wait(1);
}

void axis_lost_while_held(Walker& m) {
    holding(m);
    m.inject({.kind = Kind::Crash, .process = kY}, 5);
    expect_phase(m, MachinePhase::Fault);
}

void reset_without_an_axis(Walker& m) {
    axis_lost(m);
    ask_for(m, CommandKind::Reset);
    expect_phase(m, MachinePhase::Waiting);
}

void cut_off(Walker& m) {
    running(m);
    m.inject({.kind = Kind::Cut, .process = kY}, 5);
    expect_phase(m, MachinePhase::Fault);
}

void axis_stood_still(Walker& m) {
    running(m);
    m.inject({.kind = Kind::Freeze, .process = kY}, 0.3);
    expect_phase(m, MachinePhase::Fault);
}

void frame_damaged(Walker& m) {
    running(m);
    m.inject({.kind = Kind::DamageFrame, .process = kX}, 0);
    expect_phase(m, MachinePhase::Fault);
}

/// Damages the last frame of the job, because no later frame has to join it.
void ends_elsewhere(Walker& m) {
    running(m);
    ASSERT_TRUE(m.vm.advance_until([&] { return m.vm.state()->remaining_s < 0.008; }, Ticks{10'000'000}));
    m.inject({.kind = Kind::DamageFrame, .process = kX, .ends_elsewhere = true}, 0);
    expect_phase(m, MachinePhase::Fault);
    expect_fault(m, FaultCode::PositionMismatch);
}

/// Y is cut off from the others just when it has their evidence for a frame and they lack Y's. Y runs the frame, and
/// the others do not. The right time depends on the frame.
void frames_differ(Walker& m) {
    running(m);
    for (int tries = 0; tries < 40 && m.vm.state()->phase != MachinePhase::Fault; ++tries) {
        m.inject({.kind = Kind::Cut, .process = kY, .incoming = false}, 0.012);
        m.wait(0.005);
        m.inject({.kind = Kind::Cut, .process = kY, .outgoing = false}, 0.007);
        m.wait(0.2121);
    }
    expect_phase(m, MachinePhase::Fault);
    expect_fault(m, FaultCode::FramesDiffer);
}

/// One axis is started with another file than the others. `by_hand` starts it again with their file.
void other_configuration(Walker& m) {
    m.home();
    m.inject({.kind = Kind::Crash, .process = kY, .other_config = true}, 0.1);
    m.wait(0.2);
    VirtualFault by_hand{.kind = Kind::Crash, .process = kY, .at = m.vm.now() + Ticks{4'000'000}, .lasts = {100'000}};
    m.vm.schedule(by_hand);
    expect_phase(m, MachinePhase::Fault);
    expect_fault(m, FaultCode::ConfigMismatch);
}

void device_lost(Walker& m) {
    running(m);
    m.inject({.kind = Kind::KillDevice, .process = kY}, 2);
    expect_phase(m, MachinePhase::Fault);
}

void device_lost_and_back(Walker& m) {
    device_lost(m);
    m.wait(3);
}

void device_overwritten(Walker& m) {
    running(m);
    m.inject({.kind = Kind::Overwrite, .process = kY}, 1);
    expect_phase(m, MachinePhase::Fault);
}

void switch_not_found(Walker& m) {
    unhomed(m);
    m.inject({.kind = Kind::Stick, .process = kX, .contact = &PlantInputs::home, .closed = false}, 20);
    ask_for(m, CommandKind::Home);
    expect_phase(m, MachinePhase::Fault, 20);
}

void switch_stuck(Walker& m) {
    unhomed(m);
    m.inject({.kind = Kind::Stick, .process = kX, .contact = &PlantInputs::home, .closed = true}, 40);
    ask_for(m, CommandKind::Home);
    expect_phase(m, MachinePhase::Fault, 40);
}

/// Three epochs in a row run no frame, because the coordinator stands still whenever one is about to begin.
void frames_late(Walker& m) {
    running(m);
    for (int stalls = 0; stalls < 40 && m.vm.state()->phase != MachinePhase::Fault; ++stalls) {
        m.inject({.kind = Kind::Freeze, .process = kCoordinator}, 0.014);
        m.wait(0.016);
    }
    expect_phase(m, MachinePhase::Fault);
}

void coordinator_restarted(Walker& m) {
    m.home();
    m.inject({.kind = Kind::Crash, .process = kCoordinator}, 0.02);
    m.wait(0.021);
}

void coordinator_restarted_in_motion(Walker& m) {
    running(m);
    m.inject({.kind = Kind::Crash, .process = kCoordinator}, 0.1);
    m.wait(0.3);
}

void coordinator_silent_in_homing(Walker& m) {
    homing(m);
    m.inject({.kind = Kind::Crash, .process = kCoordinator}, 0.5);
    m.wait(0.7);
    expect_fault(m, FaultCode::CoordinatorSilent);
}

void coordinator_silent_in_own_move(Walker& m) {
    own_move(m);
    m.inject({.kind = Kind::Crash, .process = kCoordinator}, 0.5);
    m.wait(0.7);
    expect_fault(m, FaultCode::CoordinatorSilent);
}

/// A program is being sent, but no part of it has arrived yet.
void program_arriving(Walker& m) {
    m.home();
    m.delay_program();
}

/// The owner ends in the middle of a job.
void owner_replaced(Walker& m) {
    running(m);
    m.inject({.kind = Kind::Crash, .process = *m.vm.owner()}, 60);
    m.wait(0.5);
}

/// The coordinator stands still for so long that the axes' clock errors may exceed the limit when it continues.
void clock_uncertain(Walker& m) {
    m.home();
    m.wait(1);
    ASSERT_EQ(m.go(CommandKind::Run, 85, 45, 2).status, ReplyStatus::Accepted);
    m.wait(0.5);
    m.inject({.kind = Kind::Freeze, .process = kCoordinator}, 12);
    m.wait(12);
    expect_phase(m, MachinePhase::Fault);
}

}  // namespace

const std::vector<MachineSituation>& situations() {
    static const std::vector<MachineSituation> all{
        {"starting, an axis missing", without_an_axis, on_one_clock},
        {"unhomed", unhomed, on_one_clock},
        {"homing", homing, on_one_clock},
        {"homing, stopping", homing_that_stops, on_one_clock},
        {"idle", idle, on_one_clock},
        {"idle, a program arriving in chunks", program_arriving, on_one_clock},
        {"running", running, on_one_clock},
        {"stopping to hold", stopping_to_hold, on_one_clock},
        {"stopping", stopping, on_one_clock},
        {"holding", holding, on_one_clock},
        {"resuming", resuming, on_one_clock},
        {"paused (M0)", paused, on_one_clock},
        {"paused, axes moved in the pause", paused_away, on_one_clock},
        {"paused, jogging", jogging_in_a_pause, on_one_clock},
        {"paused, returning to its place", returning, on_one_clock},
        {"own move", own_move, on_one_clock},
        {"own move, stopping", own_move_that_stops, on_one_clock},
        {"jogging", jogging, on_one_clock},
        {"jogging, stopping", jogging_that_stops, on_one_clock},
        {"stopping at a limit", stopping_at_a_limit, on_one_clock},
        {"limit hit", limit_hit, on_one_clock},
        {"limit hit in an own move", limit_hit_in_own_move, on_one_clock},
        {"limit hit in a jog", limit_hit_in_a_jog, on_one_clock},
        {"limit hit, reset", limit_hit_and_reset, on_one_clock},
        {"steps lost", steps_lost, on_one_clock},
        {"emergency stop", emergency_stopped, on_one_clock},
        {"emergency stop in homing", emergency_stopped_in_homing, on_one_clock},
        {"emergency stop at rest", emergency_stopped_at_rest, on_one_clock},
        {"emergency stop, reset: position suspect", emergency_stopped_and_reset, on_one_clock},
        {"axis lost", axis_lost, on_one_clock},
        {"axis lost, and back", axis_lost_and_back, on_one_clock},
        {"axis lost in homing", axis_lost_in_homing, on_one_clock},
        {"axis lost at rest, and back", axis_lost_at_rest_and_back, on_one_clock},
        {"axis lost while held", axis_lost_while_held, on_one_clock},
        {"axis lost, reset without it", reset_without_an_axis, on_one_clock},
        {"axis cut off", cut_off, on_one_clock},
        {"axis stalled", axis_stood_still, on_one_clock},
        {"frame damaged in the device", frame_damaged, on_one_clock},
        {"an axis is not where its frames end", ends_elsewhere, on_one_clock},
        {"the axes ran different frames", frames_differ, on_one_clock},
        {"an axis has another configuration", other_configuration, on_one_clock},
        {"device lost", device_lost, on_one_clock},
        {"device lost, and back", device_lost_and_back, on_one_clock},
        {"device overwritten", device_overwritten, on_one_clock},
        {"home switch not found", switch_not_found, on_one_clock},
        {"home switch stuck", switch_stuck, on_one_clock},
        {"frames late", frames_late, on_one_clock},
        {"coordinator restarted", coordinator_restarted, on_one_clock},
        {"coordinator restarted in motion", coordinator_restarted_in_motion, on_one_clock},
        {"coordinator silent in homing", coordinator_silent_in_homing, on_one_clock},
        {"coordinator silent in an own move", coordinator_silent_in_own_move, on_one_clock},
        {"standby took over", owner_replaced, with_standby},
        {"standby took over, and goes on", owner_replaced, with_standby_that_goes_on},
        {"clock uncertain", clock_uncertain, on_clocks_apart},
    };
    return all;
}

std::string situation_name(const testing::TestParamInfo<MachineSituation>& info) {
    std::string name;
    for (const char c : info.param.name) {
        if (std::isalnum(static_cast<unsigned char>(c)) != 0) { name += c; }
    }
    return name;
}

}  // namespace lockstep
