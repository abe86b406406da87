// A machine does not start with keys that have expired or are not valid yet, and comes to rest on its path if they
// expire while it moves. A process whose clock is wrong by years does not join.
#include <gmock/gmock.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "services/documents/machine_file.hpp"
#include "services/security/certificates.hpp"
#include "services/security/key_directory.hpp"
#include "tests/integration/security/secured_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using std::chrono::days;
using std::chrono::sys_seconds;
using testing::AllOf;
using testing::HasSubstr;

sys_seconds now() { return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now()); }

class Expiry : public SecuredMachine {
protected:
    void SetUp() override { OwnMachine::SetUp(); }

    void make(const Period& valid) const {
        const auto made = make_keys(config(), keys(), valid, true);
        ASSERT_TRUE(made) << made.error();
    }
    /// Runs a program whose clock is wrong by this, such as -10y. Its monotonic clock is right.
    static Ran at_other_time(const std::string& by, const Words& program) {
        EXPECT_TRUE(fs::exists("/usr/bin/faketime")) << "install the package faketime";
        setenv("FAKETIME_DONT_FAKE_MONOTONIC", "1", 1);
        Words words{"-f", by};
        words.insert(words.end(), program.begin(), program.end());
        const Ran ran = ChildProcess("/usr/bin/faketime", words).wait();
        unsetenv("FAKETIME_DONT_FAKE_MONOTONIC");
        return ran;
    }
    /// Words for env that run a program in the same way, but in the process of env, so that its end ends the program.
    static Words at_clock(const std::string& by, const Words& program) {
        Words words{"LD_PRELOAD=/usr/$LIB/faketime/libfaketime.so.1", "FAKETIME=" + by,
                    "FAKETIME_DONT_FAKE_MONOTONIC=1"};
        words.insert(words.end(), program.begin(), program.end());
        return words;
    }
    bool any_logged(const std::string& text) const {
        const auto has = [&](const char* process) { return log_of(process).find(text) != std::string::npos; };
        return eventually([&] { return has("coordinator") || has("axis-X") || has("axis-Y"); });
    }
    void move_to(const std::string& x, int steps) const {
        const Ran moved = run_lockstep({"move", "X=" + x});
        EXPECT_EQ(moved.code, 0) << moved.out << moved.err;
        EXPECT_TRUE(eventually([&] { return status().axes(0).position_steps() == steps; }));
    }
};

TEST_F(Expiry, ExpiredKeysKeepTheMachineDownAndUpNamesThem) {
    make({now() - days(10), now() - 1h});
    for (const char* verb : {"up", "status", "home"}) {
        const Ran ran = run_lockstep({verb});
        EXPECT_NE(ran.code, 0) << verb;
        EXPECT_THAT(ran.out + ran.err, AllOf(HasSubstr(" expired on 20"), HasSubstr("lockstep keys make --force")))
            << verb;
    }
    EXPECT_THAT(run_lockstep({"up"}).err, HasSubstr("the certificate of "));
    make(valid_for(days(100)));
    bring_up_and_home();
}

TEST_F(Expiry, KeysOfTheFutureAndAClockOfThePastAreNamedAsAMatterOfTheClock) {
    make({now() + days(365), now() + days(400)});
    const Ran early = run_lockstep({"up"});
    EXPECT_NE(early.code, 0);
    EXPECT_THAT(early.err, AllOf(HasSubstr(" is valid only from 20"), HasSubstr("set this host's clock")));
    make(valid_for(days(100)));
    for (const char* by : {"-10y", "+10y"}) {
        const Ran wrong = at_other_time(by, {LOCKSTEP_COMMAND, "up"});
        EXPECT_NE(wrong.code, 0) << by;
        EXPECT_THAT(wrong.err, AllOf(HasSubstr("this host's clock says 20"), HasSubstr("set"))) << by;
    }
    EXPECT_THAT(at_other_time("-10y", {LOCKSTEP_COMMAND, "doctor", "--seconds", "0.1"}).out,
                HasSubstr("set this host's clock"));
}

/// One axis believes that it is a year later, when the keys are still valid.
TEST_F(Expiry, AClockThatIsWrongWithinTheKeysPeriodDoesNotMatter) {
    make({now() - days(10), now() + days(1000)});
    const ChildProcess x("/usr/bin/env", at_clock("+365d", {LOCKSTEP_AXIS, "--machine", file(), "--axis", "X"}));
    const ChildProcess coordinator(LOCKSTEP_COORDINATOR, {"--machine", file()});
    const ChildProcess y(LOCKSTEP_AXIS, {"--machine", file(), "--axis", "Y"});
    ASSERT_TRUE(becomes("Idle"));
    record();
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    const Ran run = run_lockstep({"run", write("job.gcode", kThereAndBack)});
    EXPECT_EQ(run.code, 0) << run.out << run.err;
    EXPECT_EQ(status().axes(0).position_steps(), 1600);
    EXPECT_EQ(run_lockstep({"jog", "X+", "--distance", "0.5"}).code, 0) << "its dead-man control works, too";
    expect_verified();
}

TEST_F(Expiry, AnExpiredMemberWhoseOwnClockIsWrongIsExcludedByTheOthers) {
    make({now() - days(1000), now() + days(365)});
    bring_up_and_home();
    const fs::path copy = folder() / "copy";
    fs::copy(keys(), copy, fs::copy_options::recursive);
    const auto in = [&](const char* file) { return (copy / file).string(); };
    const Ran request = ChildProcess("/usr/bin/openssl", {"req", "-new", "-key", in("client.key"), "-subj",
                                                          "/O=" + config().name + "/CN=client", "-out", in("request")})
                            .wait();
    ASSERT_EQ(request.code, 0) << request.err;
    const Ran issued =
        at_other_time("-400d", {"openssl", "x509", "-req", "-in", in("request"), "-CA", in("identity-ca.pem"), "-CAkey",
                                in("ca/identity-ca.key"), "-CAcreateserial", "-days", "30", "-out", in("client.pem")});
    ASSERT_EQ(issued.code, 0) << issued.err;
    EXPECT_THAT(foreign_peer("-", copy, "client"),
                HasSubstr("refused: DDS Security does not allow this process to join"))
        << "its own clock is right";
    const MachineSetup machine = config();
    const Ran peer = at_other_time("-390d", {LOCKSTEP_FOREIGN_PEER, std::to_string(machine.network.domain),
                                             machine.name, "-", copy.string(), "client"});
    expect_excluded(peer.out);
    for (const char* process : {"coordinator", "axis-X", "axis-Y"}) {
        EXPECT_TRUE(is_logged(process, "did not authenticate and is excluded")) << process;
    }
    EXPECT_TRUE(any_logged("certificate has expired")) << "the reason is named";
}

TEST_F(Expiry, InMotionTheAxesComeToRestOnTheirPathAndNewKeysBringTheMachineBack) {
    const sys_seconds until = now() + 45s;
    make({now() - 24h, until});
    bring_up();
    record();
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    EXPECT_THAT(log_of("axis-X"), HasSubstr("the keys of axis-X expire on "));
    std::string rows = "G21 G90\n";
    for (int i = 0; i < 40; ++i) { rows += "G1 X150 Y30 F1200\nG1 X20 Y0\n"; }
    std::this_thread::sleep_until(until - 10s);  // a short job, because a host that stalls for long ends it
    const ChildProcess run(LOCKSTEP_COMMAND, {"run", write("long.gcode", rows + "M2\n")});
    std::this_thread::sleep_until(until - 2s);
    EXPECT_EQ(status().phase(), "Running") << "this host was too slow";
    std::this_thread::sleep_until(until + 3s);

    for (const char* process : {"coordinator", "axis-X", "axis-Y"}) {
        EXPECT_TRUE(is_logged(process, std::string("the keys of ") + process + " expired on ")) << process;
    }
    const Ran looked = run_lockstep({"status"});
    EXPECT_NE(looked.code, 0);
    EXPECT_THAT(looked.err, AllOf(HasSubstr("the certificate of viewer expired on"), HasSubstr("keys make --force")));
    EXPECT_EQ(run_lockstep({"keys", "make", "--force"}).code, 0);
    const Ran down = run_lockstep({"down"});
    EXPECT_EQ(down.code, 0) << down.out << down.err;
    expect_as_planned();
    bring_up_and_home();
    move_to("30", 2400);
}

}  // namespace
}  // namespace lockstep
