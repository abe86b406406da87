// Generated keys admit their members; each error is reported with file and remedy.
#include <gmock/gmock.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "services/security/admission.hpp"
#include "services/security/key_directory.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
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
    MachineConfig machine_;
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
    const auto admission = admit(machine_, axis_member(machine_, 1));
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
    EXPECT_THAT(errors_of(axis_member(machine_, 0)), ElementsAre(HasSubstr("order of axes")));
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
