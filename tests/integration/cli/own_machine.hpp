// A machine for one test, with its own network, name and state directory. When the test ends, even if it is killed,
// everything that it started is taken down.
#pragma once

#include <gtest/gtest.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "clients/supervisor/state_directory.hpp"
#include "idl/proto/report.pb.h"
#include "services/setup/machine_setup.hpp"
#include "tests/integration/cli/command.hpp"

namespace lockstep {

/// A job that lasts some seconds, for the machine below.
inline constexpr const char* kThereAndBack = "G21 G90\nG1 X150 Y30 F1200\nG1 X20 Y0\nM2\n";

/// Two axes that home within a second: X from 0 to 200 mm, Y from -50 to 50 mm.
class OwnMachine : public testing::Test {
protected:
    void SetUp() override;
    void TearDown() override;
    /// A fixture's changes, before the file is written.
    virtual void configure(MachineSetup&) {}

    /// Writes a file beside the machine's; returns its path.
    std::string write(const std::string& name, const std::string& text) const;

    void bring_up(const Words& more = {}) const;
    void bring_up_and_home() const;
    /// Records from now on.
    void record();
    /// The recorded steps are as planned, and none is missing.
    void expect_verified();
    /// The recorded steps are as planned. The last ones of an axis that was killed may be missing.
    void expect_as_planned();
    proto::StatusReport status() const;
    /// Waits until the machine is in this phase; false if it is not within the bound.
    bool becomes(const std::string& phase) const;
    pid_t process(const std::string& name) const;

    /// The end of a process's log.
    std::string text_of_log(const std::string& process) const { return tail_of(state().log_file(process), 1000); }

    StateDirectory state() const { return StateDirectory(name_); }
    const std::string& file() const { return file_; }
    const std::filesystem::path& folder() const { return folder_; }
    const std::string& lcm_url() const { return lcm_url_; }

private:
    Ran verify_until(const std::function<bool(const Ran&)>& is_enough);
    void start_guard();

    std::string name_;
    std::filesystem::path folder_;
    std::string file_;
    std::string lcm_url_;
    std::string log_;
    std::optional<ChildProcess> logger_;
    pid_t guard_ = 0;
    int guard_pipe_ = -1;
};

}  // namespace lockstep
