// With security, members exchange keys again after participants have left. DDS then drops the keys sent to those
// participants. The exchange itself needs no security. The test observes it at a writer that every process may read.
#include "services/wire/dds/sent_keys.hpp"

#include <gtest/gtest.h>

#include "services/wire/bus/bus.hpp"
#include "services/wire/dds/topics.hpp"
#include "tests/integration/wire/eventually.hpp"
#include "tests/integration/wire/own_network.hpp"

namespace lockstep {
namespace {

constexpr int kLeave = 20;  // participants; after fewer of them keys are exchanged again

Participant open_or_throw(const NetworkConfig& network) {
    auto participant = Participant::open(network, "mill");
    if (!participant) { throw std::runtime_error(participant.error()); }
    return std::move(*participant);
}

/// The readers that a writer has had, including departed ones, and the present ones.
dds_publication_matched_status_t readers_of(const Entity& writer) {
    dds_publication_matched_status_t status{};
    dds_get_publication_matched_status(writer.handle(), &status);
    return status;
}

TEST(SentKeys, AreExchangedAgainAfterParticipantsHaveLeft) {
    const NetworkConfig network = own_network();
    Participant member = open_or_throw(network);
    const Participant other = open_or_throw(network);
    const Entity states = detail::make_writer(member, Topic<AxisState>::kSpec);
    const SentKeys keys(other.handle(), other.subscriber());
    for (int i = 0; i < kLeave; ++i) { (void)open_or_throw(network); }
    EXPECT_TRUE(eventually([&] { return readers_of(states).total_count == 1; }));
    EXPECT_TRUE(eventually([&] { return readers_of(states).current_count == 0; })) << "it does not stay";
}

}  // namespace
}  // namespace lockstep
