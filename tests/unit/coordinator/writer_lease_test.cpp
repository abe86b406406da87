// The writer's lease is taken, kept, given back, taken over, and lost by silence.
#include "core/coordinator/writer_lease.hpp"

#include <gmock/gmock.h>

#include "coordinator_parts.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

constexpr Slot kLeaseSilence_slots = kLeaseSilence_ms;  // of 1 ms

class Lease : public CoordinatorParts {
protected:
    static LeaseHolder anna() { return {.id = 7, .name = "anna", .host = "bench"}; }
    static LeaseHolder bert() { return {.id = 8, .name = "bert", .host = "office"}; }
    static Command asking(const LeaseHolder& writer, Identity client, CommandKind kind) {
        return {.client = client, .sequence = 1, .kind = kind, .writer = writer};
    }
    FaultCode take(const LeaseHolder& writer, Identity client, bool takes_over = false) {
        Command command = asking(writer, client, CommandKind::TakeLease);
        command.takes_over = takes_over;
        return code_of(lease.take(command, Tick{slot * 1000}, slot));
    }
    FaultCode check(const LeaseHolder& writer, CommandKind kind) const {
        return code_of(lease.check(asking(writer, 1, kind), Tick{slot * 1000}));
    }
    static FaultCode code_of(const CommandResult& result) { return result ? FaultCode::None : result.error().why; }
    std::string holder() const { return lease.held() ? lease.held()->writer.name : "nobody"; }
    void pass(Slot slots) {
        for (Slot i = 0; i < slots; ++i) { lease.tend(++slot, 0); }
    }

    WriterLease lease{machine};
};

TEST_F(Lease, EveryClientMayGiveCommandsWhileThereIsNoWriter) {
    EXPECT_EQ(holder(), "nobody");
    EXPECT_FALSE(lease.writer());
    EXPECT_EQ(check(anna(), CommandKind::Home), FaultCode::None);
    EXPECT_EQ(check({}, CommandKind::Run), FaultCode::None) << "also one that names no writer";
}

TEST_F(Lease, CommandsOfOtherWritersAreRefusedWithTheHolderAndSinceWhen) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    slot += 65'000;
    const auto refused = lease.check(asking(bert(), 2, CommandKind::Move), Tick{slot * 1000});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().why, FaultCode::WriterHeld);
    EXPECT_EQ(refused.error().text, "anna on bench has been the machine's writer for 65 s");
    EXPECT_THAT(find_fault(FaultCode::WriterHeld)->by_hand, HasSubstr("{take}"));
    EXPECT_EQ(check(anna(), CommandKind::Move), FaultCode::None);
}

TEST_F(Lease, NamesHowLongItHasBeenHeldInAUnitThatFits) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    const auto said_after = [&](std::int64_t seconds) {
        const Tick now{slot * 1000 + seconds * 1'000'000};
        return lease.check(asking(bert(), 2, CommandKind::Move), now).error().text;
    };
    for (const auto& [seconds, said] : std::initializer_list<std::pair<std::int64_t, const char*>>{
             {119, "for 119 s"}, {120, "for 2 min"}, {7199, "for 119 min"}, {7200, "for 2 h"}, {36'000, "for 10 h"}}) {
        EXPECT_TRUE(said_after(seconds).ends_with(said)) << said_after(seconds);
    }
}

TEST_F(Lease, TheSameNameOnAnotherHostIsToldHowToBeOneWriter) {
    LeaseHolder there = anna();
    there.id += 100;
    there.host = "office";
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    const auto text_for = [&](const LeaseHolder& writer) {
        const auto taken = lease.take(asking(writer, 2, CommandKind::TakeLease), Tick{slot * 1000}, slot);
        return taken ? std::string() : taken.error().text;
    };
    const std::string one = "LOCKSTEP_WRITER=anna@" + anna().host;
    EXPECT_NE(text_for(there).find(one), std::string::npos) << text_for(there);
    EXPECT_EQ(text_for(bert()).find("LOCKSTEP_WRITER"), std::string::npos);
}

TEST_F(Lease, HoldsAndStopsAreEverybodys) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    for (const CommandKind kind : {CommandKind::Hold, CommandKind::Stop, CommandKind::EmergencyStop}) {
        EXPECT_EQ(check(bert(), kind), FaultCode::None);
    }
    EXPECT_EQ(check(bert(), CommandKind::Jog), FaultCode::None) << "of no axis: it releases";
    for (const CommandKind kind : {CommandKind::Home, CommandKind::Move, CommandKind::Run, CommandKind::MoveOwn,
                                   CommandKind::Resume, CommandKind::Reset, CommandKind::Override}) {
        EXPECT_EQ(check(bert(), kind), FaultCode::WriterHeld);
    }
}

TEST_F(Lease, ItEndsWithTheLastOfItsWritersClients) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    ASSERT_EQ(take(anna(), 2), FaultCode::None);
    lease.give(2);
    EXPECT_EQ(holder(), "anna");
    lease.give(3);
    EXPECT_EQ(holder(), "anna") << "another client gives nothing back";
    lease.give(1);
    EXPECT_EQ(holder(), "nobody");
}

TEST_F(Lease, AnotherWriterGetsItOnlyByTakingItOver) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    EXPECT_EQ(take(bert(), 2), FaultCode::WriterHeld);
    EXPECT_EQ(holder(), "anna");
    pass(10);
    EXPECT_EQ(take(bert(), 2, true), FaultCode::None);
    EXPECT_EQ(holder(), "bert");
    EXPECT_EQ(lease.held()->since, Tick{slot * 1000});
    EXPECT_EQ(take(anna(), 1), FaultCode::WriterHeld) << "keeping it does not take it back";
    lease.give(1);
    EXPECT_EQ(holder(), "bert");
}

TEST_F(Lease, AClientThatHasLostItToAnotherGetsItOnlyByANewRequest) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    ASSERT_EQ(take(bert(), 2, true), FaultCode::None);
    lease.give(2);
    Command command = asking(anna(), 1, CommandKind::TakeLease);
    const auto refused = lease.take(command, Tick{slot * 1000}, slot);
    ASSERT_FALSE(refused) << "it repeats its request to keep what it has lost";
    EXPECT_EQ(refused.error().why, FaultCode::WriterHeld);
    EXPECT_EQ(refused.error().text, "bert on office has taken over the machine");
    EXPECT_EQ(holder(), "nobody");
    ++command.sequence;
    EXPECT_TRUE(lease.take(command, Tick{slot * 1000}, slot));
    EXPECT_EQ(holder(), "anna");
}

TEST_F(Lease, SilenceEndsItAndRepetitionKeepsIt) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    const Tick since = lease.held()->since;
    for (int i = 0; i < 10; ++i) {
        pass(kLeaseSilence_slots);
        ASSERT_EQ(take(anna(), 1), FaultCode::None);
    }
    EXPECT_EQ(lease.held()->since, since);
    pass(kLeaseSilence_slots + 2);
    EXPECT_EQ(holder(), "nobody");
}

TEST_F(Lease, SlotsMissedInTheCoordinatorsOwnStallAreNotTheWritersSilence) {
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    pass(1);
    const Slot missed = 5 * kLeaseSilence_slots;
    slot += missed + 1;
    lease.tend(slot, missed);
    EXPECT_EQ(holder(), "anna");
}

TEST_F(Lease, ANewOwnerAdoptsItForAWriterThatKeepsIt) {
    const HeldLease published{anna(), Tick{5}};
    lease.adopt(published, slot);
    EXPECT_EQ(check(bert(), CommandKind::Move), FaultCode::WriterHeld);
    EXPECT_EQ(check(anna(), CommandKind::Move), FaultCode::None);
    pass(kLeaseSilence_slots);
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    pass(kLeaseSilence_slots);
    EXPECT_EQ(lease.held(), published);
    lease.adopt(published, slot);
    pass(kLeaseSilence_slots + 2);
    EXPECT_EQ(holder(), "nobody") << "its writer did not keep it";
}

TEST_F(Lease, AClientThatKeepsItOftenCountsOnce) {
    ASSERT_EQ(take(anna(), 2), FaultCode::None);
    for (int n = 0; n < 100; ++n) { ASSERT_EQ(take(anna(), 1), FaultCode::None); }
    lease.give(1);
    EXPECT_EQ(holder(), "anna") << "her other client has it still";
    lease.give(2);
    EXPECT_EQ(holder(), "nobody");
}

TEST_F(Lease, TheFirstClientThatKeepsAnAdoptedOneStandsForItsWriter) {
    lease.adopt(HeldLease{anna(), Tick{5}}, slot);
    ASSERT_EQ(take(anna(), 1), FaultCode::None);
    lease.give(1);
    EXPECT_EQ(holder(), "nobody");
}

TEST_F(Lease, ALeaseWithoutAnIdentityIsRefused) { EXPECT_EQ(take({}, 1), FaultCode::BadProgram); }

TEST_F(Lease, ItKnowsABoundedNumberOfClients) {
    for (Identity client = 1; client <= 1000; ++client) { ASSERT_EQ(take(anna(), client), FaultCode::None); }
    for (Identity client = 969; client <= 1000; ++client) { lease.give(client); }
    EXPECT_EQ(holder(), "nobody");
}

}  // namespace
}  // namespace lockstep
