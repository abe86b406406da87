// The firmware's device equals the simulated one, word by word and step by step, for any host.
#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "tests/property/firmware/random_host.hpp"

namespace lockstep::testing {
namespace {

/// How many pieces are loaded: LOCKSTEP_FIRMWARE_PIECES, or so many that it takes a second.
std::uint64_t pieces_to_load() {
    const char* const asked = std::getenv("LOCKSTEP_FIRMWARE_PIECES");
    return asked != nullptr ? std::stoull(asked) : 300'000;
}

TEST(FirmwareDevice, HasTheWordsOfTheSimulatedDeviceForAnyHost) {
    constexpr int kTurns = 200;
    constexpr std::uint64_t kAllStatusBits = registers::kStatusLostTicks * 2 - 1;
    std::uint64_t pieces = 0;
    std::uint64_t steps = 0;
    std::uint64_t seen = 0;
    for (std::uint64_t seed = 1; pieces < pieces_to_load(); ++seed) {
        RandomHost host(seed);
        for (int turn = 0; turn < kTurns; ++turn) {
            const auto difference = host.turn();
            ASSERT_FALSE(difference) << "seed " << seed << ", turn " << turn << ": " << *difference;
        }
        pieces += host.pieces();
        steps += host.steps();
        seen |= host.seen();
    }
    EXPECT_GT(steps, pieces / 2) << "the hosts make devices move";
    EXPECT_EQ(seen, kAllStatusBits) << "the hosts reach all that can happen to a run";
}

}  // namespace
}  // namespace lockstep::testing
