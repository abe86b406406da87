// Real processes that do not belong to the machine get no answer, move nothing, and are reported.
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>

#include "services/security/access_documents.hpp"
#include "services/security/certificates.hpp"
#include "services/security/key_directory.hpp"
#include "tests/integration/security/secured_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

class ForeignPeers : public SecuredMachine {
protected:
    /// Keys for the same names, from the foreign peer's own authority.
    fs::path forged_keys() const {
        const fs::path forged = folder() / "forged";
        EXPECT_TRUE(make_keys(config(), forged, valid_for(std::chrono::days(30)), false));
        return forged;
    }
    /// A member's true certificate and key, with permissions that the peer signed itself.
    fs::path keys_with_own_permissions(const std::string& member, const std::string& as) const {
        const fs::path mixed = folder() / "mixed";
        EXPECT_TRUE(make_keys(config(), mixed, valid_for(std::chrono::days(30)), false));
        for (const char* file : {".pem", ".key"}) {
            fs::copy_file(keys() / (member + file), mixed / (member + file), fs::copy_options::overwrite_existing);
        }
        fs::copy_file(keys() / "identity-ca.pem", mixed / "identity-ca.pem", fs::copy_options::overwrite_existing);
        const MachineSetup machine = config();
        const auto own = make_authority({machine.name, "permissions"}, valid_for(std::chrono::days(30)));
        const std::string wanted = permissions_xml(
            machine, {as, Role::Client, {}}, "CN=" + member + ",O=" + machine.name, valid_for(std::chrono::days(30)));
        std::ofstream(mixed / "permissions-ca.pem") << own->certificate_pem();
        std::ofstream(mixed / "governance.p7s") << sign(governance_xml(machine), *own).value();
        std::ofstream(mixed / (member + ".p7s")) << sign(wanted, *own).value();
        return mixed;
    }
};

TEST_F(ForeignPeers, AMemberIsAcceptedSoTheTestWouldDetectAcceptance) {
    const std::string output = foreign_peer("-", keys(), "client", {"1"});
    EXPECT_THAT(output, Not(HasSubstr("matched 0\n")));
    EXPECT_THAT(output, Not(HasSubstr("received 0\n")));
    EXPECT_TRUE(eventually([&] { return status().job() == 2; })) << "its command to home was executed";
}

TEST_F(ForeignPeers, AreExcludedAndReported) {
    const auto without = begin_foreign_peer("-", "-", "-");
    const auto forger = begin_foreign_peer("-", forged_keys(), "coordinator");
    const auto self_signed = begin_foreign_peer("-", keys_with_own_permissions("viewer", "client"), "viewer");
    for (const auto& each : {without.get(), forger.get(), self_signed.get()}) { expect_excluded(each->wait().out); }
    for (const char* process : {"coordinator", "axis-X", "axis-Y"}) {
        EXPECT_TRUE(is_logged(process, "has no certificate and is excluded")) << process;
        EXPECT_TRUE(is_logged(process, "did not authenticate and is excluded")) << process;
    }
}

TEST_F(ForeignPeers, AViewerMayNotCommand) {
    const std::string output = foreign_peer("-", keys(), "viewer");
    EXPECT_THAT(output, HasSubstr("refused: cannot open the DDS topic lockstep/command"));
    EXPECT_THAT(output, HasSubstr("matched 0\n"));
    expect_untouched();
}

TEST_F(ForeignPeers, ChangedPermissionsAreRefusedAtOnce) {
    const fs::path changed = folder() / "changed";
    fs::copy(keys(), changed, fs::copy_options::recursive);
    std::ifstream in(changed / "viewer.p7s");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    text.replace(text.find("<subscribe>"), 11, "<publish>  ");
    std::ofstream(changed / "viewer.p7s") << text;
    EXPECT_THAT(foreign_peer("-", changed, "viewer"),
                HasSubstr("refused: DDS Security does not allow this process to join"));
    expect_untouched();
}

TEST_F(ForeignPeers, AnAxisMayNotPublishForAnother) {
    EXPECT_THAT(foreign_peer("0", keys(), "axis-Y"), HasSubstr("refused: cannot open the DDS topic"));
    EXPECT_THAT(foreign_peer("1", keys(), "axis-Y", {"3"}), HasSubstr("matched 3\n")) << "it may publish, for itself";
    EXPECT_TRUE(is_logged("coordinator", "is about axis 0, but its writer is not that axis"));
    EXPECT_TRUE(is_logged("axis-X", "is about axis 0, but its writer is not that axis"));
    expect_untouched();
}

TEST_F(ForeignPeers, TheGoodMachineMovesExactlyAsWithoutSecurity) {
    const Ran moved = run_lockstep({"move", "X=30", "Y=10"});
    EXPECT_EQ(moved.code, 0) << moved.out << moved.err;
    EXPECT_TRUE(eventually([&] { return status().axes(0).position_steps() == 2400; }));
    expect_verified();
}

}  // namespace
}  // namespace lockstep
