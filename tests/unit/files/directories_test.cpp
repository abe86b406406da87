// Directories of the files that processes share.
#include "services/files/directories.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace lockstep {
namespace {

using testing::HasSubstr;

TEST(SharedStates, AreOfOneMachineInOneDomainAndNetwork) {
    EXPECT_EQ(shared_states_file("mill", 3), shared_states_file("mill", 3));
    EXPECT_NE(shared_states_file("mill", 3), shared_states_file("lathe", 3));
    EXPECT_NE(shared_states_file("mill", 3), shared_states_file("mill", 4));
    EXPECT_THAT(shared_states_file("mill", 3).string(), HasSubstr("/dev/shm/"));
}

}  // namespace
}  // namespace lockstep
