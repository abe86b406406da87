// Commands and programs as they arrive, and why a command is refused.
#include "core/coordinator/command_inbox.hpp"

#include "coordinator_parts.hpp"
#include "core/coordinator/reply.hpp"

namespace lockstep {
namespace {

TEST(CommandInbox, KeepsCommandsUntilTheyAreTaken) {
    CommandInbox inbox;
    const std::array commands{Command{.client = 1, .sequence = 1}, Command{.client = 2, .sequence = 1}};
    inbox.receive(commands);
    inbox.receive(commands);
    std::vector<Identity> clients;
    const auto note = [&](const Command& command) { clients.push_back(command.client); };
    inbox.take_each(note);
    EXPECT_EQ(clients, (std::vector<Identity>{1, 2, 1, 2}));
    inbox.take_each(note);
    EXPECT_EQ(clients.size(), 4u);
}

TEST(CommandInbox, KnowsCommandsThatWereAnswered) {
    CommandInbox inbox;
    Command command{.client = 1, .sequence = 5};
    EXPECT_EQ(inbox.answer_to(command), nullptr);
    inbox.note(reply_to(command, {}, 3));
    ASSERT_NE(inbox.answer_to(command), nullptr);
    EXPECT_EQ(inbox.answer_to(command)->job, 3u);
    command.sequence = 4;
    EXPECT_NE(inbox.answer_to(command), nullptr) << "older than the last";
    command.sequence = 6;
    EXPECT_EQ(inbox.answer_to(command), nullptr);
}

TEST(Reply, NamesTheReasonOfARefusal) {
    const Reply reply = reply_to({.client = 1, .sequence = 5}, refuse(FaultCode::Busy, "the machine is Running"), 3);
    EXPECT_EQ(reply.status, ReplyStatus::Refused);
    EXPECT_EQ(reply.fault, FaultCode::Busy);
    EXPECT_EQ(reply.text, "the machine is Running");
    EXPECT_EQ(reply.job, 0u);
}

TEST(ProgramStore, KeepsTheNewestFewPrograms) {
    ProgramStore programs{MachineConfig{}};
    for (std::uint64_t id = 1; id <= 5; ++id) { programs.accept(id, {.name = std::to_string(id)}); }
    EXPECT_EQ(programs.find(1), nullptr);
    ASSERT_NE(programs.find(2), nullptr);
    programs.accept(5, {.name = "again"});
    EXPECT_EQ(programs.find(5)->head().name, "again");
    EXPECT_NE(programs.find(2), nullptr);
}

using Readiness = CoordinatorParts;

TEST_F(Readiness, RefusesCoordinatedMovesByAnUncertainClockWithTheLimit) {
    receive_all();
    EXPECT_TRUE(check_clocks(loop()));
    AxisState state = state_of(0);
    state.clock_error = machine.clock_error_to_begin() + Ticks{1};
    axes.take(state, slot);
    const CommandResult result = check_clocks(loop());
    ASSERT_FALSE(result);
    EXPECT_EQ(result.error().why, FaultCode::ClockUncertain);
    EXPECT_NE(result.error().text.find("axis X"), std::string::npos);
}

}  // namespace
}  // namespace lockstep
