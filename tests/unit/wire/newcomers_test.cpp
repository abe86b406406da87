// Who comes without proof is told, each once; who proves himself is not.
#include <gmock/gmock.h>

#include "services/wire/dds/dds_log.hpp"
#include "services/wire/dds/newcomers.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kOpen = "SPDP ST0 1100a3e:7a:3:1c1 bes c3f NEW (data udp/127.0.0.1:5@1 meta udp/127.0.0.1:9@1)";
constexpr const char* kSecure =
    "SPDP ST0 bcc8f613:b3:c:1c1 bes fc3f (secure) NEW (data udp/10.0.0.7:5@1 meta udp/10.0.0.7:9@1)";

TEST(Newcomers, WhoHasNoCertificateIsToldAtOnce) {
    Newcomers newcomers;
    EXPECT_EQ(newcomers.hear(0s, kOpen),
              "participant 1100a3e:7a:3:1c1 at udp/127.0.0.1:9@1 has no certificate and is shut out");
    EXPECT_THAT(newcomers.unproved(10s), IsEmpty());
}

TEST(Newcomers, WhoDoesNotProveHimselfInTimeIsToldOnce) {
    Newcomers newcomers;
    EXPECT_FALSE(newcomers.hear(0s, kSecure));
    EXPECT_THAT(newcomers.unproved(1s), IsEmpty());
    EXPECT_THAT(newcomers.unproved(2s),
                ElementsAre("participant bcc8f613:b3:c:1c1 at udp/10.0.0.7:9@1 has not proved to "
                            "belong to this machine and is shut out"));
    EXPECT_THAT(newcomers.unproved(3s), IsEmpty());
}

TEST(Newcomers, WhoProvesHimselfOrLeavesIsNot) {
    Newcomers newcomers;
    (void)newcomers.hear(0s, kSecure);
    (void)newcomers.hear(1s, "handshake (lguid=aa:bb:c:1c1 rguid=bcc8f613:b3:c:1c1) succeeded");
    EXPECT_THAT(newcomers.unproved(9s), IsEmpty());
    (void)newcomers.hear(10s, kSecure);
    (void)newcomers.hear(11s, "SPDP ST3 bcc8f613:b3:c:1c1 delete");
    EXPECT_THAT(newcomers.unproved(19s), IsEmpty());
}

TEST(Newcomers, WhatOneSaysOfItselfDoesNotCount) {
    Newcomers newcomers;
    EXPECT_TRUE(newcomers.hear(0s, std::string(kOpen) + " QOS={user_data=\"(secure)\"}"));
    (void)newcomers.hear(0s, kSecure);
    EXPECT_TRUE(newcomers.hear(1s, std::string(kOpen) + " QOS={user_data=\"rguid=bcc8f613:b3:c:1c1) succeeded\"}"));
    EXPECT_EQ(newcomers.unproved(9s).size(), 1U);
}

TEST(RepeatFilter, SaysOnceWhatIsRepeatedWhoeverItIsOf) {
    RepeatFilter filter;
    EXPECT_EQ(filter.pass(0s, "handshake of 1:2:3:c1 failed"), "handshake of 1:2:3:c1 failed");
    EXPECT_FALSE(filter.pass(1s, "handshake of 4:5:6:c1 failed"));
    EXPECT_FALSE(filter.pass(9s, "handshake of 1:2:3:c1 failed"));
    EXPECT_EQ(filter.pass(9s, "another thing"), "another thing");
    EXPECT_EQ(filter.pass(10s, "handshake of 7:8:9:c1 failed"), "handshake of 7:8:9:c1 failed (and 2 more like it)");
}

}  // namespace
}  // namespace lockstep
