// Processes with another protocol are reported, and no others.
#include <gmock/gmock.h>

#include "services/wire/dds/partitions.hpp"
#include "services/wire/dds/protocol_version.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

TEST(ProtocolVersion, ReportsAnotherProtocolWithBothNumbers) {
    const auto text = other_version(calling_card(kProtocol + 1, "mill"), "mill");
    ASSERT_TRUE(text);
    EXPECT_THAT(*text, HasSubstr("machine 'mill' uses protocol " + std::to_string(kProtocol + 1) + ", this one " +
                                 std::to_string(kProtocol)));
}

TEST(ProtocolVersion, ReportsNothingForItsOwnProtocolOtherMachinesAndInvalidCards) {
    EXPECT_FALSE(other_version(calling_card(kProtocol, "mill"), "mill"));
    EXPECT_FALSE(other_version(calling_card(kProtocol + 1, "lathe"), "mill"));
    EXPECT_FALSE(other_version(calling_card(kProtocol + 1, "mill2"), "mill"));
    for (const char* card :
         {"", "lockstep", "lockstep ", "lockstep x mill", "lockstep 99999999999 mill", "other 2 mill"}) {
        EXPECT_FALSE(other_version(card, "mill")) << card;
    }
}

TEST(ProtocolVersion, IsAPartOfThePartitions) {
    EXPECT_EQ(partition_of("mill", std::nullopt), "mill@" + std::to_string(kProtocol));
    EXPECT_EQ(partition_of("mill", 1), "mill@" + std::to_string(kProtocol) + "/1");
}

}  // namespace
}  // namespace lockstep
