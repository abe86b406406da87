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
    EXPECT_FALSE(upload.answered());
    EXPECT_TRUE(upload.take_answer(answer_to(chunks[0]), 3s));
    EXPECT_EQ(upload.answered(), 3s);
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

}  // namespace
}  // namespace lockstep
