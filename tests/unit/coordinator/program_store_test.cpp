// Programs arrive in parts. Each part is answered, and the answer to a part that cannot be run gives the reason.
#include "core/coordinator/program/program_store.hpp"

#include <gtest/gtest.h>

#include "tests/unit/coordinator/long_axes.hpp"

namespace lockstep {
namespace {

class ProgramInParts : public testing::Test {
protected:
    static ProgramPart part(std::uint32_t index, std::vector<Block> blocks) {
        return {.client = 3,
                .sequence = 10 + index,
                .program = 7,
                .index = index,
                .head = {.name = "job", .axes = {"X", "Y"}, .start_mm = {0, 0}},
                .blocks = std::move(blocks)};
    }
    static Block to(double x_mm, std::int32_t line) { return {line, ProgramMove{{x_mm, 0}, 10, false}}; }
    static FaultCode fault_of(const Reply& reply) { return reply.fault; }

    ProgramStore programs{two_long_axes()};
};

TEST_F(ProgramInParts, IsTakenPartByPart) {
    EXPECT_TRUE(programs.take(part(0, {to(10, 1)}), 100).is_new);
    const auto second = programs.take(part(1, {to(20, 2)}), 101);
    EXPECT_TRUE(second.is_new);
    EXPECT_EQ(second.reply.parts, 2u);
    const auto again = programs.take(part(1, {to(20, 2)}), 102);
    EXPECT_FALSE(again.is_new) << "it is acknowledged again";
    EXPECT_EQ(again.reply.parts, 2u);
    EXPECT_EQ(programs.find(7)->known(), 2u);
}

TEST_F(ProgramInParts, TakesAsLongAsItsKnownShareSays) {
    ProgramPart first = part(0, {to(10, 1), to(20, 2)});
    EXPECT_TRUE(programs.take(first, 100).is_new);
    const double known_s = programs.find(7)->seconds_from({0, {}});
    ProgramPart second = part(1, {});
    second.share = 0.25;
    EXPECT_TRUE(programs.take(second, 101).is_new);
    EXPECT_DOUBLE_EQ(programs.find(7)->seconds_from({0, {}}), 4 * known_s);
    ProgramPart last = part(2, {});
    last.is_last = true;
    EXPECT_TRUE(programs.take(last, 102).is_new);
    EXPECT_DOUBLE_EQ(programs.find(7)->seconds_from({0, {}}), known_s) << "nothing is unknown any more";
}

TEST_F(ProgramInParts, StaysWhileItIsInUseAndNewerOnesReplaceTheOthers) {
    const Program program{.name = "job", .axes = {"X", "Y"}, .start_mm = {0, 0}, .blocks = {to(10, 1)}};
    programs.accept(1, program);
    programs.accept(2, program);
    const std::shared_ptr<const KnownProgram> in_use = programs.find(1);
    for (std::uint64_t id = 3; id < 3 + ProgramStore::kProgramsKept; ++id) { programs.accept(id, program); }
    EXPECT_EQ(programs.find(1), in_use);
    EXPECT_EQ(programs.find(2), nullptr);
    EXPECT_NE(programs.find(4), nullptr);
}

TEST_F(ProgramInParts, OfWhichTheBeginningIsMissingIsNotTaken) {
    const auto taken = programs.take(part(1, {to(20, 2)}), 100);
    EXPECT_FALSE(taken.is_new);
    EXPECT_EQ(taken.reply.status, ReplyStatus::Refused);
    EXPECT_EQ(fault_of(taken.reply), FaultCode::UnknownProgram);
}

TEST_F(ProgramInParts, RefusesAPartThatTheMachineCannotRunWithItsLine) {
    ASSERT_TRUE(programs.take(part(0, {to(10, 1)}), 100).is_new);
    for (int n = 0; n < 2; ++n) {
        const auto taken = programs.take(part(1, {to(501, 17)}), 101);
        EXPECT_FALSE(taken.is_new);
        EXPECT_EQ(taken.reply.status, ReplyStatus::Refused);
        EXPECT_EQ(fault_of(taken.reply), FaultCode::OutsideTravel);
        EXPECT_TRUE(taken.reply.text.starts_with("line 17: X 501")) << taken.reply.text;
        EXPECT_EQ(taken.reply.parts, 1u);
    }
    ProgramPart question = part(0, {});
    question.is_question = true;
    EXPECT_EQ(fault_of(programs.take(question, 102).reply), FaultCode::OutsideTravel);
}

TEST_F(ProgramInParts, NamesNoLineWhereNoneIsWrong) {
    ProgramPart first = part(0, {});
    first.head.axes = {"X", "Q"};
    const auto taken = programs.take(first, 100);
    EXPECT_EQ(taken.reply.status, ReplyStatus::Refused);
    EXPECT_TRUE(taken.reply.text.starts_with("the program moves axis Q")) << taken.reply.text;
}

/// Keeps no rows, only the number before which rows were released.
class ReleasedRows final : public RowStore {
public:
    explicit ReleasedRows(std::uint32_t& released) : released_(&released) {}
    std::expected<void, std::string> append(std::span<const double>) override { return {}; }
    bool read(std::uint32_t, std::span<double>) override { return false; }
    std::uint64_t free_rows() override { return 1000; }
    void release_before(std::uint32_t number) override { *released_ = number; }

private:
    std::uint32_t* released_;
};

TEST_F(ProgramInParts, MakesRoomWhereItsBlocksWereRun) {
    std::uint32_t released = 0;
    ProgramStore store(two_long_axes(), [&](std::size_t) { return std::make_unique<ReleasedRows>(released); });
    ASSERT_TRUE(store.take(part(0, {to(10, 1), to(20, 2)}), 100).is_new);
    store.find(7)->release_before(1);
    EXPECT_EQ(released, 1u);
}

}  // namespace
}  // namespace lockstep
