// A machine with processes that authenticate, and a foreign peer.
#pragma once

#include <memory>
#include <string>

#include "tests/integration/cli/own_machine.hpp"

namespace lockstep {

class SecuredMachine : public OwnMachine {
protected:
    void SetUp() override;
    void configure(MachineSetup& machine) override;

    std::filesystem::path keys() const { return folder() / "keys"; }
    MachineSetup config() const;

    /// Runs the foreign peer and returns its output. partition, keys, member and how: see foreign_peer.cpp.
    std::string foreign_peer(const std::string& partition, const std::string& keys, const std::string& member,
                             const Words& how = {}) const;
    /// The same, in parallel to the test.
    std::unique_ptr<ChildProcess> begin_foreign_peer(const std::string& partition, const std::string& keys,
                                                     const std::string& member, const Words& how = {}) const;
    /// No process accepted the foreign peer, and the machine is unchanged.
    void expect_excluded(const std::string& output) const;
    /// All axes are at their park positions, no job was begun, no fault.
    void expect_untouched() const;
    std::string log_of(const std::string& process) const { return tail_of(state().log_file(process), 2000); }
    bool is_logged(const std::string& process, const std::string& text) const;
};

}  // namespace lockstep
