// A machine in virtual time that is recorded into a log, for the tests here.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "clients/planning/plan_summary.hpp"
#include "clients/simulation/machine_recorder.hpp"
#include "services/documents/machine_file.hpp"
#include "services/documents/program_file.hpp"
#include "services/record/sinks.hpp"
#include "services/virtual/virtual_machine.hpp"

namespace lockstep::test {

/// A directory of the test's own.
inline std::filesystem::path test_directory() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const auto path =
        std::filesystem::path(testing::TempDir()) / "lockstep_offline" / info->test_suite_name() / info->name();
    std::filesystem::create_directories(path);
    return path;
}

inline MachineConfig example(const std::string& name) {
    return load_machine_file("deploy/examples/" + name + ".textproto").value();
}

/// From where the machine is parked.
inline Program program_of(const MachineConfig& machine, std::string_view gcode) {
    return parse_gcode(gcode, gcode_setup(machine, parked_mm(machine), "example.gcode")).value();
}

class RecordedMachine {
public:
    RecordedMachine(const MachineConfig& machine, const std::filesystem::path& log)
        : sink_(LogWriter::open(log).value()), vm_({.machine = machine, .config_hash = config_hash(machine)}),
          recorder_(vm_, sink_) {}
    ~RecordedMachine() {
        recorder_.finish();
        EXPECT_TRUE(sink_.finish());
    }

    VirtualMachine& vm() { return vm_; }
    bool reaches(MachinePhase phase) {
        return vm_.advance_until([&] { return vm_.state() && vm_.state()->phase == phase; }, Ticks{200'000'000});
    }
    void advance_ms(std::int64_t ms) { vm_.advance_until([] { return false; }, Ticks{ms * 1000}); }
    void home() {
        ASSERT_TRUE(reaches(MachinePhase::Idle));
        vm_.command(CommandKind::Home);
        ASSERT_TRUE(reaches(MachinePhase::Homing));
        ASSERT_TRUE(reaches(MachinePhase::Idle));
    }
    void begin(Program program) {
        vm_.give_program(++programs_, std::move(program));
        vm_.command(CommandKind::Run, 0, programs_);
        ASSERT_TRUE(reaches(MachinePhase::Running));
    }

private:
    LogSink sink_;
    VirtualMachine vm_;
    MachineRecorder recorder_;
    std::uint64_t programs_ = 0;
};

}  // namespace lockstep::test
