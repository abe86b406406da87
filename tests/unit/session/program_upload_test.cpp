// The program that a client sends: it is fed while it is sent, and another one takes its place.
#include "clients/session/upload/program_upload.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

using namespace std::chrono_literals;

const ProgramHead kHead{.name = "job", .axes = {"X"}, .start_mm = {0}};

Reply answer_to(const ProgramChunk& chunk) {
    return {.client = 7, .sequence = chunk.sequence, .parts = chunk.index + 1, .free_blocks = 100};
}

TEST(ProgramUpload, FeedsTheSenderUntilTheProgramEnds) {
    ProgramUpload upload{7};
    EXPECT_TRUE(upload.due(0s).empty());
    int fed = 0;
    const ProgramSender& sender = upload.open(kHead, {}, [&](ProgramSender& into) {
        into.append({1, ProgramMove{{1}, 5, false}});
        if (++fed == 2) { into.end(); }
    });
    (void)upload.due(0s);
    EXPECT_FALSE(sender.is_ended());
    const auto chunks = upload.due(1ms);
    (void)upload.due(2ms);
    EXPECT_EQ(fed, 2);
    ASSERT_EQ(chunks.size(), 1u);
    EXPECT_TRUE(upload.take_answer(answer_to(chunks[0]), 3s));
    EXPECT_TRUE(sender.is_done());
}

TEST(ProgramUpload, AnotherProgramHasAnotherIdAndIgnoresOldAnswers) {
    ProgramUpload upload{7};
    upload.open(kHead).end();
    const auto first = upload.due(0s);
    ASSERT_EQ(first.size(), 1u);
    EXPECT_NE(first[0].program, 0u);
    EXPECT_NE(upload.open(kHead).program(), first[0].program);
    EXPECT_FALSE(upload.take_answer(answer_to(first[0]), 1s));
    upload.close();
    EXPECT_EQ(upload.sender(), nullptr);
    EXPECT_TRUE(upload.due(2s).empty());
}

TEST(ProgramUpload, WaitsLongForACoordinatorThatPublishesStates) {
    ProgramUpload upload{7};
    upload.open(kHead).end();
    const auto chunks = upload.due(0s);
    EXPECT_FALSE(upload.is_overdue({}, 10s)) << "the wait begins with the first question";
    EXPECT_FALSE(upload.is_overdue({}, 70s));
    EXPECT_TRUE(upload.is_overdue({}, 71s));
    EXPECT_TRUE(upload.take_answer(answer_to(chunks[0]), 80s));
    EXPECT_FALSE(upload.is_overdue({}, 140s)) << "each answer begins it again";
    EXPECT_TRUE(upload.is_overdue({}, 141s));
    upload.open(kHead);
    EXPECT_FALSE(upload.is_overdue({}, 141s)) << "and so does another program";
}

TEST(ProgramUpload, DoesNotWaitLongForASilentCoordinator) {
    const OwnerSight silent{.is_silent = true};
    ProgramUpload upload{7};
    upload.open(kHead);
    EXPECT_FALSE(upload.is_overdue(silent, 1s));
    EXPECT_FALSE(upload.is_overdue({}, 4s));
    EXPECT_FALSE(upload.is_overdue(silent, 7s));
    EXPECT_TRUE(upload.is_overdue(silent, 8s));
}

}  // namespace
}  // namespace lockstep
