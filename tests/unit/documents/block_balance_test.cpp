// Blocks that are not closed are found with the places of their keys, also in texts with other errors.
#include "services/documents/text/block_balance.hpp"

#include <gmock/gmock.h>

namespace lockstep {
namespace {

std::vector<std::string> open_in(std::string_view text) {
    std::vector<std::string> names;
    for (const BlockBalance::Block& block : block_balance(text).open) {
        names.push_back(block.key + " " + std::to_string(block.place.line) + ":" + std::to_string(block.place.column));
    }
    return names;
}

TEST(BlockBalanceTest, NamesOpenBlocksWithTheirPlaces) {
    EXPECT_THAT(open_in("a {\n  b { c: 1 }\n  d: {\n    e <\n"), testing::ElementsAre("a 1:1", "d 3:3", "e 4:5"));
    EXPECT_EQ(text_of_open(block_balance("a {\n b <")),
              "Expected \">\": the text ends within b (line 2) within a (line 1); add the 2 missing ends");
    EXPECT_EQ(text_of_open(block_balance("a {\n")),
              "Expected \"}\": the text ends within a (line 1); add the missing }");
}

TEST(BlockBalanceTest, IgnoresBracesInTextsAndComments) {
    EXPECT_THAT(open_in("a { b: \"{\" # {\n c: '}' }"), testing::IsEmpty());
    EXPECT_FALSE(block_balance("a { b: \"}\" # }\n }").surplus);
}

TEST(BlockBalanceTest, FindsTheFirstBraceThatClosesNothing) {
    EXPECT_EQ(block_balance("a { }\n }\n}").surplus, (TextPlace{2, 2}));
    EXPECT_EQ(block_balance("a { >").surplus, (TextPlace{1, 5}));
    EXPECT_FALSE(block_balance("").surplus);
}

TEST(BlockBalanceTest, ReadsTextsOfAnyKind) {
    EXPECT_THAT(open_in("\x01\x02 \"unfinished\n a {"), testing::ElementsAre("a 2:2"));
    EXPECT_THAT(open_in("{"), testing::SizeIs(1));
}

}  // namespace
}  // namespace lockstep
