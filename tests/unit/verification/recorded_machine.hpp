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

// The processes of a machine of two axes.
inline constexpr std::size_t kY = 1;
inline constexpr std::size_t kCoordinator = 2;

/// A directory for one test.
inline std::filesystem::path test_directory() {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    const auto path =
        std::filesystem::path(testing::TempDir()) / "lockstep_offline" / info->test_suite_name() / info->name();
    std::filesystem::create_directories(path);
    return path;
}

inline MachineSetup example(const std::string& name) {
    return load_machine_file("deploy/examples/" + name + ".textproto").value();
}

/// The program of a text that starts at the park positions.
inline Program program_of(const MachineConfig& machine, std::string_view gcode) {
    return parse_gcode(gcode, gcode_setup(machine, parked_mm(machine), "example.gcode")).value();
}

class RecordedMachine {
public:
    RecordedMachine(const MachineSetup& machine, const std::filesystem::path& log)
        : RecordedMachine(VirtualOptions{.machine = machine, .config_hash = config_hash(machine)}, log) {}
    RecordedMachine(const VirtualOptions& options, const std::filesystem::path& log)
        : sink_(LogWriter::open(log).value()), vm_(options), recorder_(vm_, sink_) {}
    ~RecordedMachine() {
        recorder_.finish();
        EXPECT_TRUE(sink_.finish());
    }

    VirtualMachine& vm() { return vm_; }
    bool reaches(MachinePhase phase) {
        return vm_.advance_until([&] { return vm_.state() && vm_.state()->phase == phase; }, Ticks{200'000'000});
    }
    void advance_ms(std::int64_t ms) {
        vm_.advance_until([] { return false; }, Ticks{ms * 1000});
    }
    /// Sends the command until it is answered.
    void command(CommandKind kind, std::uint64_t program = 0) {
        bool answered = false;
        for (int tries = 0; tries < 50 && !answered; ++tries) {
            const std::uint64_t sequence = vm_.command(kind, {}, program);
            answered = vm_.advance_until([&] { return vm_.reply_to(sequence) != nullptr; }, Ticks{200'000});
        }
        ASSERT_TRUE(answered);
    }
    void set_overrides(const Overrides& overrides) {
        const std::uint64_t sequence = vm_.set_overrides(overrides);
        ASSERT_TRUE(vm_.advance_until([&] { return vm_.reply_to(sequence) != nullptr; }, Ticks{200'000}));
    }
    void home() {
        ASSERT_TRUE(reaches(MachinePhase::Idle));
        command(CommandKind::Home);
        ASSERT_TRUE(reaches(MachinePhase::Homing));
        ASSERT_TRUE(reaches(MachinePhase::Idle));
    }
    void begin(Program program) {
        vm_.give_program(++programs_, std::move(program));
        command(CommandKind::Run, programs_);
        ASSERT_TRUE(reaches(MachinePhase::Running));
    }
    /// Begins moves in which each axis goes to its place on its own.
    void begin_own(Program program) {
        vm_.give_program(++programs_, std::move(program));
        command(CommandKind::MoveOwn, programs_);
        ASSERT_TRUE(reaches(MachinePhase::Running));
    }

private:
    LogSink sink_;
    VirtualMachine vm_;
    MachineRecorder recorder_;
    std::uint64_t programs_ = 0;
};

}  // namespace lockstep::test
