// Rights to publish and read: they depend on the role, and each axis has its own.
#include <gmock/gmock.h>

#include "services/security/access_documents.hpp"
#include "services/wire/dds/partitions.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;
using testing::Not;

MachineSetup mill() {
    MachineSetup machine;
    machine.name = "mill";
    machine.network.domain = 7;
    machine.axes.resize(2);
    machine.axes[0].name = "X";
    machine.axes[1].name = "Y";
    return machine;
}

std::string published(const Member& member) {
    const std::string rule = allow_rule_xml(mill(), member);
    return rule.substr(0, rule.find("<subscribe>"));
}

TEST(Rights, OnlyACoordinatorSendsSetpoints) {
    const std::string setpoint = "<topic>lockstep/setpoint</topic>";
    EXPECT_THAT(published(coordinator_member()), HasSubstr(setpoint));
    EXPECT_THAT(published(standby_member()), HasSubstr(setpoint));
    for (const Member& member : {axis_member(mill(), MotorIndex{0}), client_member(), viewer_member()}) {
        EXPECT_THAT(published(member), Not(HasSubstr(setpoint))) << member.name;
    }
}

TEST(Rights, AnAxisWritesInItsOwnPartitionAlone) {
    const std::string machine = partition_of("mill");
    EXPECT_THAT(published(axis_member(mill(), MotorIndex{1})), HasSubstr("<partition>" + machine + "/1</partition>"));
    EXPECT_THAT(published(axis_member(mill(), MotorIndex{1})),
                Not(HasSubstr("<partition>" + machine + "</partition>")));
    EXPECT_THAT(published(axis_member(mill(), MotorIndex{1})), Not(HasSubstr(machine + "/0")));
}

TEST(Rights, AViewerPublishesNothing) { EXPECT_THAT(published(viewer_member()), Not(HasSubstr("<publish>"))); }

TEST(Rights, HoldInTheMachinesDomainAndNoOther) {
    EXPECT_THAT(published(client_member()), HasSubstr("<id>7</id>"));
    EXPECT_THAT(governance_xml(mill()), HasSubstr("<id>7</id>"));
}

TEST(Rights, EveryTopicHasWritersAndReaders) {
    for (const TopicRights& topic : rights()) {
        EXPECT_FALSE(topic.writers.empty()) << topic.topic;
        EXPECT_FALSE(topic.readers.empty()) << topic.topic;
    }
}

}  // namespace
}  // namespace lockstep
