// A whole machine in virtual time has one writer at a time, with two clients, each kind of takeover, and silence.
#include <gmock/gmock.h>

#include "tests/unit/virtual/jogger.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// A client with a writer of its own. It repeats a command until it is answered, as a session does.
class Client {
public:
    Client(VirtualMachine& vm, LeaseHolder writer, Identity client)
        : vm_(vm), writer_(std::move(writer)), client_(client) {}

    Reply ask(Command command) {
        command.client = client_;
        command.sequence = ++sequence_;
        command.writer = writer_;
        for (int tries = 0; tries < 20; ++tries) {
            vm_.send(command);
            if (vm_.advance_until([&] { return answer(command.sequence) != nullptr; }, Ticks{250'000})) {
                return *answer(command.sequence);
            }
        }
        return {.status = ReplyStatus::Refused, .text = "no reply"};
    }
    Reply ask(CommandKind kind) { return ask({.kind = kind}); }
    Reply take() { return ask(CommandKind::TakeLease); }
    Reply take_over() { return ask({.kind = CommandKind::TakeLease, .takes_over = true}); }
    /// Repeats the request for the lease for `seconds`, as often as a session does.
    void keep(double seconds) {
        for (double passed = 0; passed < seconds; passed += 0.5) {
            (void)take();
            (void)vm_.advance_until([] { return false; }, Ticks{500'000});
        }
    }
    std::uint64_t writer() const { return writer_.id; }

private:
    const Reply* answer(std::uint64_t sequence) const {
        for (auto reply = vm_.replies().rbegin(); reply != vm_.replies().rend(); ++reply) {
            if (reply->client == client_ && reply->sequence == sequence) { return &*reply; }
        }
        return nullptr;
    }

    VirtualMachine& vm_;
    LeaseHolder writer_;
    Identity client_;
    std::uint64_t sequence_ = 0;
};

FaultCode code_of(const Reply& reply) { return reply.status == ReplyStatus::Accepted ? FaultCode::None : reply.fault; }

class TwoWriters : public Rig {
protected:
    explicit TwoWriters(const VirtualOptions& options = {.machine = small_machine()}) : Rig(options) {}

    std::string writer() {
        wait(0.01);
        return vm.state()->lease ? vm.state()->lease->writer.name : "nobody";
    }
    void begin_long_program() {
        home();
        vm.give_program(77, program_of({{95, 5}, {5, 5}}, 20));
        ASSERT_EQ(code_of(anna.take()), FaultCode::None);
        ASSERT_EQ(code_of(anna.ask({.kind = CommandKind::Run, .program = 77})), FaultCode::None);
        ASSERT_TRUE(reaches(MachinePhase::Running, 2));
    }

    Client anna{vm, {.id = 7, .name = "anna", .host = "bench"}, 100};
    Client anna_too{vm, {.id = 7, .name = "anna", .host = "bench"}, 101};
    Client bert{vm, {.id = 8, .name = "bert", .host = "office"}, 200};
};

TEST_F(TwoWriters, OneThatHasTheLeaseKeepsTheOtherFromMovingButNotFromStopping) {
    begin_long_program();
    EXPECT_EQ(writer(), "anna");
    const Reply refused = bert.ask({.kind = CommandKind::Override, .feed_percent = 50});
    EXPECT_EQ(code_of(refused), FaultCode::WriterHeld);
    EXPECT_THAT(refused.text, HasSubstr("anna on bench"));
    EXPECT_EQ(code_of(bert.take()), FaultCode::WriterHeld);
    EXPECT_EQ(code_of(anna_too.ask({.kind = CommandKind::Override, .feed_percent = 50})), FaultCode::None)
        << "another client of the same writer";
    EXPECT_EQ(code_of(bert.ask(CommandKind::Hold)), FaultCode::None);
    ASSERT_TRUE(reaches(MachinePhase::Holding, 2));
    EXPECT_EQ(code_of(bert.ask(CommandKind::Resume)), FaultCode::WriterHeld);
    EXPECT_EQ(code_of(anna.ask(CommandKind::Resume)), FaultCode::None);
    ASSERT_TRUE(reaches(MachinePhase::Running, 2));
    EXPECT_EQ(code_of(bert.ask(CommandKind::Stop)), FaultCode::None);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    EXPECT_EQ(code_of(bert.ask(CommandKind::EmergencyStop)), FaultCode::None);
    ASSERT_TRUE(reaches(MachinePhase::Fault, 2));
    EXPECT_EQ(code_of(bert.ask(CommandKind::Reset)), FaultCode::WriterHeld);
    EXPECT_EQ(code_of(anna.ask(CommandKind::Reset)), FaultCode::None);
}

TEST_F(TwoWriters, WhoTakesTheMachineOverIsTheWriterAndTheJobGoesOn) {
    begin_long_program();
    EXPECT_EQ(code_of(bert.take_over()), FaultCode::None);
    EXPECT_EQ(writer(), "bert");
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    EXPECT_EQ(code_of(anna.take()), FaultCode::WriterHeld) << "she does not take it back by keeping it";
    EXPECT_EQ(code_of(anna.ask({.kind = CommandKind::Override, .feed_percent = 50})), FaultCode::WriterHeld);
    EXPECT_EQ(code_of(bert.ask({.kind = CommandKind::Override, .feed_percent = 50})), FaultCode::None);
    EXPECT_EQ(code_of(bert.ask(CommandKind::GiveLease)), FaultCode::None);
    EXPECT_EQ(writer(), "nobody");
}

TEST_F(TwoWriters, AWriterThatFallsSilentLosesTheLeaseAndItsJobGoesOn) {
    begin_long_program();
    anna.keep(4);
    EXPECT_EQ(writer(), "anna");
    wait(3.2);
    EXPECT_EQ(writer(), "nobody");
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running);
    EXPECT_EQ(code_of(bert.ask(CommandKind::Stop)), FaultCode::None);
    ASSERT_TRUE(reaches(MachinePhase::Idle, 2));
    EXPECT_EQ(code_of(bert.take()), FaultCode::None);
}

MachineConfig machine_that_holds() {
    MachineConfig machine = small_machine();
    machine.unattended_job = UnattendedJob::IsHeld;
    return machine;
}

/// The job of a client that falls silent is held.
class Unattended : public TwoWriters {
protected:
    Unattended() : TwoWriters({.machine = MachineSetup{machine_that_holds()}}) {}

    Reply run_as_anna() {
        home();
        (void)anna.take();
        vm.give_program(700, program_of({{90, 90}}, 5));
        return anna.ask({.kind = CommandKind::Run, .program = 700});
    }
};

TEST_F(Unattended, IsHeldWhenItsClientFallsSilentAndGoesOnWhenAPersonResumesIt) {
    ASSERT_EQ(code_of(run_as_anna()), FaultCode::None);
    anna.keep(4);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running) << "it is attended";
    wait(3.6);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Holding) << describe();
    EXPECT_EQ(writer(), "nobody");
    EXPECT_EQ(code_of(bert.ask(CommandKind::Resume)), FaultCode::None);
    wait(1);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running) << "resumed by hand, it runs on";
    EXPECT_EQ(code_of(bert.ask(CommandKind::Stop)), FaultCode::None);
}

TEST_F(Unattended, RunsOnIfItsClientLeavesInOrderOrAnotherClientFallsSilent) {
    ASSERT_EQ(code_of(run_as_anna()), FaultCode::None);
    (void)anna_too.take();  // and nothing more
    anna.keep(4);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running) << "another client of the same writer fell silent";
    EXPECT_EQ(code_of(anna.ask(CommandKind::GiveLease)), FaultCode::None);
    wait(5);
    EXPECT_EQ(vm.state()->phase, MachinePhase::Running) << describe();
}

TEST_F(TwoWriters, AJogEndsWhenAnotherTakesTheMachineOver) {
    home();
    Jogger key(vm);
    key.press({{.axis = AxisIndex{0}, .speed_mm_s = 20}});
    pass(vm, {&key}, Ticks{300'000});
    ASSERT_EQ(vm.state()->phase, MachinePhase::Jogging);
    EXPECT_EQ(code_of(bert.take_over()), FaultCode::None);
    pass(vm, {&key}, Ticks{700'000});
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle) << "though its key is still held";
    EXPECT_TRUE(vm.axis_states()[0]->at_rest);
    EXPECT_EQ(fault(), FaultCode::None);
}

TEST_F(TwoWriters, AJogOfTheFormerWriterEndsThoughTheLeaseIsGivenBackAtOnce) {
    home();
    ASSERT_EQ(code_of(anna.take()), FaultCode::None);
    Jogger key(vm);
    key.write_as(anna.writer());
    key.press({{.axis = AxisIndex{0}, .speed_mm_s = 20}});
    pass(vm, {&key}, Ticks{300'000});
    ASSERT_EQ(vm.state()->phase, MachinePhase::Jogging);
    EXPECT_EQ(code_of(bert.take_over()), FaultCode::None);
    EXPECT_EQ(code_of(bert.ask(CommandKind::GiveLease)), FaultCode::None);
    pass(vm, {&key}, Ticks{700'000});
    EXPECT_EQ(vm.state()->phase, MachinePhase::Idle);
    EXPECT_TRUE(vm.axis_states()[0]->at_rest);
    EXPECT_EQ(fault(), FaultCode::None);
}

TEST_F(TwoWriters, NoWriterIsLeftByTheCoordinatorsOwnStall) {
    home();
    ASSERT_EQ(code_of(anna.take()), FaultCode::None);
    vm.schedule({.kind = VirtualFault::Kind::Freeze, .process = 2, .at = vm.now(), .lasts = {6'000'000}});
    wait(6.05);
    EXPECT_EQ(writer(), "anna");
}

class TwoWritersWithStandby : public TwoWriters {
protected:
    TwoWritersWithStandby() : TwoWriters({.machine = small_machine(), .coordinators = 2}) {}
    void kill_owner() {
        vm.schedule({.kind = VirtualFault::Kind::Crash, .process = *vm.owner(), .at = vm.now(), .lasts = {60'000'000}});
        wait(0.5);
        ASSERT_TRUE(vm.owner());
    }
};

TEST_F(TwoWritersWithStandby, TheLeaseOutlivesItsCoordinator) {
    home();
    ASSERT_EQ(code_of(anna.take()), FaultCode::None);
    wait(0.1);
    const HeldLease held = *vm.state()->lease;
    kill_owner();
    EXPECT_EQ(code_of(bert.take()), FaultCode::WriterHeld);
    EXPECT_EQ(code_of(anna.ask(CommandKind::Reset)), FaultCode::None) << "before she has repeated her request";
    anna.keep(4);
    EXPECT_EQ(vm.state()->lease, held);
    wait(3.2);
    EXPECT_EQ(writer(), "nobody");
}

}  // namespace
}  // namespace lockstep
