// A repeated command is recognised while its client is among the newest. The clients' identities do not matter.
#include "core/protocol/client_memory.hpp"

#include <gtest/gtest.h>

namespace lockstep {
namespace {

constexpr std::size_t kMany = 5000;

TEST(ClientMemory, TheNewestClientsAreKnownWhateverTheirIdentity) {
    ClientMemory<std::size_t> memory;
    for (std::size_t n = 0; n < kMany; ++n) {
        const Identity falling = kMany - n;
        memory.note(falling, n);
        const std::size_t first = n < memory.kClients ? 0 : n - memory.kClients + 1;
        for (std::size_t known = first; known <= n; ++known) {
            ASSERT_NE(memory.find(kMany - known), nullptr) << "client " << known << " of " << n;
            EXPECT_EQ(*memory.find(kMany - known), known);
        }
    }
}

TEST(ClientMemory, TheOldestClientGivesWay) {
    ClientMemory<int> memory;
    for (Identity client = 0; client < memory.kClients; ++client) { memory.note(client, 1); }
    memory.note(memory.kClients, 1);
    EXPECT_EQ(memory.find(0), nullptr);
    EXPECT_NE(memory.find(1), nullptr);
}

TEST(ClientMemory, ARepeatedClientIsTheNewestAndReplacesNone) {
    ClientMemory<int> memory;
    for (Identity client = 0; client < memory.kClients; ++client) { memory.note(client, 1); }
    memory.note(0, 2);
    EXPECT_EQ(*memory.find(0), 2);
    EXPECT_NE(memory.find(1), nullptr);
    memory.note(memory.kClients, 1);
    EXPECT_NE(memory.find(0), nullptr);
    EXPECT_EQ(memory.find(1), nullptr);
}

}  // namespace
}  // namespace lockstep
