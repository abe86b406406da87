#include "tests/integration/security/secured_machine.hpp"

#include <gmock/gmock.h>

#include "services/documents/machine_file.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {

using testing::HasSubstr;

void SecuredMachine::configure(MachineSetup& machine) { machine.security.directory = keys(); }

void SecuredMachine::SetUp() {
    OwnMachine::SetUp();
    const Ran made = run_lockstep({"keys", "make"});
    ASSERT_EQ(made.code, 0) << made.out << made.err;
    bring_up();
    record();
    const Ran home = run_lockstep({"home"});
    ASSERT_EQ(home.code, 0) << home.out << home.err;
}

MachineSetup SecuredMachine::config() const { return load_machine_file(file()).value(); }

std::unique_ptr<ChildProcess> SecuredMachine::begin_foreign_peer(const std::string& partition, const std::string& keys,
                                                                 const std::string& member, const Words& how) const {
    const MachineSetup machine = config();
    Words words{std::to_string(machine.network.domain), machine.name, partition, keys, member};
    words.insert(words.end(), how.begin(), how.end());
    return std::make_unique<ChildProcess>(LOCKSTEP_FOREIGN_PEER, words);
}

std::string SecuredMachine::foreign_peer(const std::string& partition, const std::string& keys,
                                         const std::string& member, const Words& how) const {
    const Ran ran = begin_foreign_peer(partition, keys, member, how)->wait();
    EXPECT_EQ(ran.code, 0) << ran.out << ran.err;
    return ran.out;
}

void SecuredMachine::expect_excluded(const std::string& output) const {
    EXPECT_THAT(output, HasSubstr("matched 0\n"));
    EXPECT_THAT(output, HasSubstr("received 0\n"));
    expect_untouched();
}

void SecuredMachine::expect_untouched() const {
    const proto::StatusReport report = status();
    EXPECT_EQ(report.phase(), "Idle");
    EXPECT_FALSE(report.has_fault());
    EXPECT_EQ(report.job(), 1U) << "homing was the last";
    ASSERT_EQ(report.axes_size(), 2);
    EXPECT_EQ(report.axes(0).position_mm(), 1);
    EXPECT_EQ(report.axes(1).position_mm(), -49);
}

bool SecuredMachine::is_logged(const std::string& process, const std::string& text) const {
    return eventually([&] { return log_of(process).find(text) != std::string::npos; });
}

}  // namespace lockstep
