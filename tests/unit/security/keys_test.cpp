// Generated keys admit their members; each error is reported with file and remedy.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "services/security/access_documents.hpp"
#include "services/security/admission.hpp"
#include "services/security/expiry_watch.hpp"
#include "services/security/key_directory.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class Keys : public testing::Test {
protected:
    void SetUp() override {
        folder_ = fs::path(testing::TempDir()) / ("lockstep-keys-" + std::to_string(getpid()));
        fs::create_directories(folder_);
        machine_.name = "mill";
        machine_.axes.resize(2);
        machine_.axes[0].name = "X";
        machine_.axes[1].name = "Y";
        machine_.security.directory = (folder_ / "keys").string();
    }
    void TearDown() override { fs::remove_all(folder_); }

    fs::path keys() const { return machine_.security.directory; }
    void make(std::chrono::days valid = std::chrono::days(365)) const {
        const auto made = make_keys(machine_, keys(), valid_for(valid), false);
        ASSERT_TRUE(made) << made.error();
    }
    std::vector<std::string> errors_of(const Member& member, std::chrono::days later = {}) const {
        const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
        return check_member(machine_, keys(), member, now + later).errors;
    }

    fs::path folder_;
    MachineSetup machine_;
};

TEST_F(Keys, LetEveryMemberIn) {
    make();
    for (const Member& member : members_of(machine_)) {
        EXPECT_THAT(errors_of(member), IsEmpty()) << member.name;
        EXPECT_TRUE(admit(machine_, member)->membership.credentials);
    }
}

TEST_F(Keys, AreNotNeededWithoutSecurity) {
    machine_.security = {};
    const auto admission = admit(machine_, axis_member(machine_, MotorIndex{1}));
    ASSERT_TRUE(admission);
    EXPECT_FALSE(admission->membership.credentials);
    EXPECT_EQ(admission->membership.axis, 1U);
}

TEST_F(Keys, ThatAreMissingAreNamedWithTheRemedy) {
    const auto admission = admit(machine_, client_member());
    ASSERT_FALSE(admission);
    EXPECT_THAT(admission.error(), HasSubstr((keys() / "identity-ca.pem").string() + ": there is no such file"));
    EXPECT_THAT(admission.error(), HasSubstr("lockstep keys make"));
}

TEST_F(Keys, ThatOthersMayReadAreRefusedWithTheChmodThatCorrectsIt) {
    make();
    const fs::path key = keys() / "client.key";
    EXPECT_EQ(fs::status(key).permissions(), fs::perms(0600));
    fs::permissions(key, fs::perms(0640));
    EXPECT_THAT(errors_of(client_member()), IsEmpty()) << "a group may";
    fs::permissions(key, fs::perms(0644));
    EXPECT_THAT(errors_of(client_member()), ElementsAre(HasSubstr("chmod 600 " + key.string())));
}

TEST_F(Keys, InADirectoryThatOthersMayWriteAreRefusedWithTheChmodThatCorrectsIt) {
    make();
    fs::permissions(keys(), fs::perms(0755));
    EXPECT_THAT(errors_of(client_member()), IsEmpty()) << "other users may read";
    fs::permissions(keys(), fs::perms(0777));
    EXPECT_THAT(errors_of(client_member()), ElementsAre(HasSubstr("chmod go-w " + keys().string())));
    fs::permissions(keys(), fs::perms(0700));
    fs::permissions(keys() / "ca" / "identity-ca.key", fs::perms(0604));
    EXPECT_THAT(errors_of(client_member()), ElementsAre(HasSubstr("chmod 600 " + (keys() / "ca").string())));
}

TEST_F(Keys, ExpireOnTheirDateAndWarnBefore) {
    make(std::chrono::days(100));
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    EXPECT_THAT(check_member(machine_, keys(), client_member(), now).warnings, IsEmpty());
    EXPECT_THAT(check_member(machine_, keys(), client_member(), now + std::chrono::days(80)).warnings,
                ElementsAre(HasSubstr("expires on")));
    EXPECT_THAT(errors_of(client_member(), std::chrono::days(101)), ElementsAre(HasSubstr("expired on")));
    EXPECT_THAT(errors_of(client_member(), std::chrono::days(-3)), ElementsAre(HasSubstr("set this host's clock")));
}

TEST_F(Keys, NameWhatExpiredTheClockAndTheRemedy) {
    make(std::chrono::days(100));
    const auto expired = errors_of(axis_member(machine_, MotorIndex{0}), std::chrono::days(101));
    ASSERT_EQ(expired.size(), 1U);
    EXPECT_THAT(expired[0],
                AllOf(HasSubstr("the certificate of axis-X expired on 20"), HasSubstr("this host's clock says 20"),
                      HasSubstr("lockstep keys make --force"), HasSubstr("if that clock is wrong, set it")));
    const auto early = errors_of(axis_member(machine_, MotorIndex{0}), -std::chrono::days(10 * 365));
    ASSERT_EQ(early.size(), 1U);
    EXPECT_THAT(early[0], AllOf(HasSubstr("the certificate of axis-X is valid only from 20"),
                                HasSubstr("this host's clock says 20"), HasSubstr("set this host's clock")));
}

TEST_F(Keys, AreValidFromTheFirstSecondToTheLast) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    const Period valid{now - std::chrono::hours(1), now + std::chrono::hours(1)};
    ASSERT_TRUE(make_keys(machine_, keys(), valid, false));
    const auto errors_at = [&](std::chrono::sys_seconds time) {
        return check_member(machine_, keys(), client_member(), time).errors;
    };
    EXPECT_THAT(errors_at(valid.from), IsEmpty());
    EXPECT_THAT(errors_at(valid.from - std::chrono::seconds(1)), ElementsAre(HasSubstr("valid only from")));
    EXPECT_THAT(errors_at(valid.until - std::chrono::seconds(1)), IsEmpty());
    EXPECT_THAT(errors_at(valid.until), ElementsAre(HasSubstr("expired on")));
    EXPECT_EQ(admit(machine_, client_member())->until, valid.until);
}

/// The authorities and the permissions have ends of their own if they were made in another way.
TEST_F(Keys, AreJudgedByTheFileThatExpiresFirst) {
    make(std::chrono::days(365));
    const Period soon = valid_for(std::chrono::days(50));
    const auto authority = make_authority({machine_.name, "permissions"}, valid_for(std::chrono::days(365)));
    const std::string permissions = permissions_xml(machine_, client_member(), "CN=client,O=mill", soon);
    EXPECT_EQ(period_in(permissions)->until, soon.until);
    EXPECT_EQ(period_in(permissions)->from, soon.from);
    std::ofstream(keys() / "permissions-ca.pem") << authority->certificate_pem();
    std::ofstream(keys() / "governance.p7s") << sign(governance_xml(machine_), *authority).value();
    std::ofstream(keys() / "client.p7s") << sign(permissions, *authority).value();
    EXPECT_THAT(errors_of(client_member()), IsEmpty());
    EXPECT_THAT(errors_of(client_member(), std::chrono::days(51)),
                ElementsAre(AllOf(HasSubstr("client.p7s: the permissions of client expired on"))));

    const auto short_lived = make_authority({machine_.name, "permissions"}, valid_for(std::chrono::days(20)));
    std::ofstream(keys() / "permissions-ca.pem") << short_lived->certificate_pem();
    std::ofstream(keys() / "governance.p7s") << sign(governance_xml(machine_), *short_lived).value();
    std::ofstream(keys() / "client.p7s") << sign(permissions, *short_lived).value();
    EXPECT_THAT(
        errors_of(client_member(), std::chrono::days(21)),
        ElementsAre(HasSubstr("permissions-ca.pem: the certificate of the authority for permissions expired on")))
        << "and its signatures are not called wrong";
}

TEST(ExpiryWatch, RemindsOnceADayInTheLastMonthAndOnceAtTheEnd) {
    const std::chrono::sys_seconds until(std::chrono::days(20000));
    ExpiryWatch watch("axis-X", until);
    EXPECT_FALSE(watch.due(until - std::chrono::days(31)));
    int reminders = 0;
    for (auto now = until - std::chrono::days(30); now < until; now += std::chrono::minutes(10)) {
        const auto text = watch.due(now);
        reminders += text ? 1 : 0;
        if (text) { EXPECT_THAT(*text, HasSubstr("the keys of axis-X expire on 2024-10-04T00:00:00Z")); }
    }
    EXPECT_EQ(reminders, 30);
    EXPECT_THAT(watch.due(until).value(),
                AllOf(HasSubstr("the keys of axis-X expired on"), HasSubstr("keys make --force")));
    EXPECT_FALSE(watch.due(until + std::chrono::days(100)));
}

TEST_F(Keys, OfAnotherRunAreNotMixed) {
    make();
    ASSERT_TRUE(make_keys(machine_, folder_ / "others", valid_for(std::chrono::days(365)), false));
    for (const char* file : {"client.pem", "client.p7s"}) {
        fs::copy_file(folder_ / "others" / file, keys() / file, fs::copy_options::overwrite_existing);
    }
    EXPECT_THAT(errors_of(client_member()), ElementsAre(HasSubstr("client.pem: was not issued by this authority"),
                                                        HasSubstr("client.key: is not the key of the certificate"),
                                                        HasSubstr("client.p7s: the signature is not valid")));
}

TEST_F(Keys, AreMadeForOneMachineAndItsOrderOfAxes) {
    make();
    std::swap(machine_.axes[0], machine_.axes[1]);
    EXPECT_THAT(errors_of(axis_member(machine_, MotorIndex{0})), ElementsAre(HasSubstr("order of axes")));
    EXPECT_THAT(errors_of(client_member()), IsEmpty());
    machine_.network.domain = 5;
    EXPECT_THAT(errors_of(client_member()), ElementsAre(HasSubstr("governance.p7s"), HasSubstr("client.p7s")));
}

TEST_F(Keys, AreNeverOverwrittenUnasked) {
    make();
    const auto again = make_keys(machine_, keys(), valid_for(std::chrono::days(1)), false);
    ASSERT_FALSE(again);
    EXPECT_THAT(again.error(), HasSubstr("--force"));
    EXPECT_THAT(errors_of(client_member()), IsEmpty());
    const auto replaced = make_keys(machine_, keys(), valid_for(std::chrono::days(365)), true);
    ASSERT_TRUE(replaced) << replaced.error();
    EXPECT_TRUE(fs::exists(fs::path(replaced->replaced) / "ca" / "identity-ca.key")) << "nothing is lost";
}

TEST_F(Keys, ThatAreNotKeysAreReported) {
    make();
    std::ofstream(keys() / "client.pem") << "a certificate, surely\n";
    EXPECT_THAT(errors_of(client_member()), testing::Contains(HasSubstr("client.pem: is not a certificate in PEM")));
}

}  // namespace
}  // namespace lockstep
