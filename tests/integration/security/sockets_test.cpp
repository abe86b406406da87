// No process listens beyond the configured interface.
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <memory>
#include <sstream>

#include "tests/integration/cli/own_machine.hpp"

namespace lockstep {
namespace {

std::string output_of(const char* command) {
    const std::unique_ptr<FILE, int (*)(FILE*)> pipe(popen(command, "r"), &pclose);
    std::string text;
    std::array<char, 4096> buffer{};
    while (std::fgets(buffer.data(), buffer.size(), pipe.get()) != nullptr) { text += buffer.data(); }
    return text;
}

using Sockets = OwnMachine;

TEST_F(Sockets, OfDdsAreBoundToTheConfiguredInterface) {
    bring_up();
    std::istringstream lines(output_of("ss -Huln"));
    std::size_t tied = 0;
    for (std::string state, received, sent, local, peer; lines >> state >> received >> sent >> local >> peer;) {
        const auto port = std::stoul(local.substr(local.rfind(':') + 1));
        const bool is_dds = port >= 7400 && port < 7400 + 250 * 233;  // DDS's well-known ports begin there
        if (local.find("%lo:") != local.npos) { ++tied; }
        if (is_dds && port < 32768) { EXPECT_NE(local.find("%lo:"), local.npos) << local; }
    }
    EXPECT_GE(tied, 9U) << "three processes, each with a unicast and two multicast sockets";
}

}  // namespace
}  // namespace lockstep
