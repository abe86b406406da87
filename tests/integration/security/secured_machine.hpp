// A machine whose processes prove who they are, and somebody who does not belong there.
#pragma once

#include <memory>
#include <string>

#include "tests/integration/cli/own_machine.hpp"

namespace lockstep {

class SecuredMachine : public OwnMachine {
protected:
    void SetUp() override;
    void configure(MachineConfig& machine) override;

    std::filesystem::path keys() const { return folder() / "keys"; }
    MachineConfig config() const;

    /// What the stranger says came of it. partition, keys, member and how: as stranger.cpp has them.
    std::string stranger(const std::string& partition, const std::string& keys, const std::string& member,
                         const Words& how = {}) const;
    /// The same, beside the test.
    std::unique_ptr<Command> begin_stranger(const std::string& partition, const std::string& keys,
                                            const std::string& member, const Words& how = {}) const;
    /// Nobody took notice of him, and the machine is as it was.
    void expect_shut_out(const std::string& said) const;
    /// All axes stand where homing parked them, no job was begun, nothing is wrong.
    void expect_untouched() const;
    std::string log_of(const std::string& process) const { return tail_of(state().log_file(process), 2000); }
    bool is_logged(const std::string& process, const std::string& text) const;
};

}  // namespace lockstep
