// What happens when the keys of a machine that is up expire.
#include <gmock/gmock.h>

#include <thread>

#include "services/documents/machine_file.hpp"
#include "services/security/certificates.hpp"
#include "services/security/key_directory.hpp"
#include "tests/integration/security/secured_machine.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

class Expiry : public OwnMachine {
protected:
    void configure(MachineConfig& machine) override { machine.security.directory = folder() / "keys"; }
};

TEST_F(Expiry, Look) {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    const MachineConfig machine = load_machine_file(file()).value();
    ASSERT_TRUE(make_keys(machine, folder() / "keys", {now - 24h, now + 30s}, false));
    bring_up();
    EXPECT_EQ(run_lockstep({"home"}).code, 0);
    std::cout << "homed after " << (std::chrono::system_clock::now() - now) / 1s << std::endl;
    std::this_thread::sleep_until(now + 24s);
    const auto move = std::make_unique<ChildProcess>(LOCKSTEP_COMMAND, Words{"move", "X=150", "--in", "20"});
    std::this_thread::sleep_until(now + 40s);
    const Ran moved = move->wait();
    std::cout << moved.code << moved.out << moved.err << std::endl;
    const Ran ran = run_lockstep({"status"});
    std::cout << ran.code << ran.out << ran.err << std::endl;
    for (const char* p : {"coordinator", "axis-X", "axis-Y"}) std::cout << p << "\n" << tail_of(state().log_file(p), 2000) << std::endl;
}

}  // namespace
}  // namespace lockstep
