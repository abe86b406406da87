// Peers without authentication are reported, each once; authenticated ones are not.
#include <gmock/gmock.h>

#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/unauthenticated_peers.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kOpen = "SPDP ST0 1100a3e:7a:3:1c1 bes c3f NEW (data udp/127.0.0.1:5@1 meta udp/127.0.0.1:9@1)";
constexpr const char* kSecure =
    "SPDP ST0 bcc8f613:b3:c:1c1 bes fc3f (secure) NEW (data udp/10.0.0.7:5@1 meta udp/10.0.0.7:9@1)";

TEST(UnauthenticatedPeers, ReportsPeerWithoutCertificateAtOnce) {
    UnauthenticatedPeers peers;
    EXPECT_EQ(peers.note_line(0s, kOpen),
              "participant 1100a3e:7a:3:1c1 at udp/127.0.0.1:9@1 has no certificate and is excluded");
    EXPECT_THAT(peers.due(10s), IsEmpty());
}

TEST(UnauthenticatedPeers, ReportsPeerThatDoesNotAuthenticateInTimeOnce) {
    UnauthenticatedPeers peers;
    EXPECT_FALSE(peers.note_line(0s, kSecure));
    EXPECT_THAT(peers.due(1s), IsEmpty());
    EXPECT_THAT(peers.due(2s), ElementsAre("participant bcc8f613:b3:c:1c1 at udp/10.0.0.7:9@1 did not authenticate "
                                           "and is excluded"));
    EXPECT_THAT(peers.due(3s), IsEmpty());
}

TEST(UnauthenticatedPeers, IgnoresPeerThatAuthenticatesOrLeaves) {
    UnauthenticatedPeers peers;
    (void)peers.note_line(0s, kSecure);
    (void)peers.note_line(1s, "handshake (lguid=aa:bb:c:1c1 rguid=bcc8f613:b3:c:1c1) succeeded");
    EXPECT_THAT(peers.due(9s), IsEmpty());
    (void)peers.note_line(10s, kSecure);
    (void)peers.note_line(11s, "SPDP ST3 bcc8f613:b3:c:1c1 delete");
    EXPECT_THAT(peers.due(19s), IsEmpty());
}

TEST(UnauthenticatedPeers, IgnoresPeersOwnDescription) {
    UnauthenticatedPeers peers;
    EXPECT_TRUE(peers.note_line(0s, std::string(kOpen) + " QOS={user_data=\"(secure)\"}"));
    (void)peers.note_line(0s, kSecure);
    EXPECT_TRUE(peers.note_line(1s, std::string(kOpen) + " QOS={user_data=\"rguid=bcc8f613:b3:c:1c1) succeeded\"}"));
    EXPECT_EQ(peers.due(9s).size(), 1U);
}

TEST(RepeatFilter, PassesOneMessageOfAKindWhoeverItIsAbout) {
    RepeatFilter filter;
    EXPECT_EQ(filter.pass(0s, "handshake of 1:2:3:c1 failed"), "handshake of 1:2:3:c1 failed");
    EXPECT_FALSE(filter.pass(1s, "handshake of 4:5:6:c1 failed"));
    EXPECT_FALSE(filter.pass(9s, "handshake of 1:2:3:c1 failed"));
    EXPECT_EQ(filter.pass(9s, "another thing"), "another thing");
    EXPECT_EQ(filter.pass(10s, "handshake of 7:8:9:c1 failed"), "handshake of 7:8:9:c1 failed (and 2 more like it)");
}

}  // namespace
}  // namespace lockstep
