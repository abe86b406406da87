// The result of a configuration: its defaults, its text and its hash.
#include "services/documents/machine_file.hpp"

#include <gtest/gtest.h>

#include <cctype>

#include "core/motion/step_source.hpp"
#include "idl/proto/machine.pb.h"
#include "tests/unit/documents/machine_text_examples.hpp"

namespace lockstep {
namespace {

MachineSetup parse(std::string_view text) {
    auto machine = parse_machine(text);
    if (machine) { return *std::move(machine); }
    ADD_FAILURE() << to_text("machine", machine.error());
    return {};
}

TEST(MachineFile, AbsentKeysHaveTheDocumentedDefaults) {
    const MachineSetup machine = parse(kShortest);
    EXPECT_EQ(machine.tick_ns, 1000);
    EXPECT_EQ(machine.timing.slot_us, 10'000);
    EXPECT_EQ(machine.timing.stall_slots, 10);
    EXPECT_EQ(machine.timing.late_check_slots, 2);
    EXPECT_EQ(machine.timing.freshness_slots, 11);
    EXPECT_EQ(machine.timing.send_ahead_slots, 31);
    EXPECT_EQ(machine.timing.frame_slots, 5);
    EXPECT_EQ(machine.network.interface, "lo");
    EXPECT_EQ(machine.network.domain, 0U);
    EXPECT_EQ(machine.network.lcm_url, "udpm://239.255.76.67:7667?ttl=0&recv_buf_size=4194304");
    EXPECT_TRUE(machine.record.own_logs);
    EXPECT_EQ(machine.record.directory, "");
    EXPECT_EQ(machine.record.size_limit_mb, 256);
    EXPECT_TRUE(machine.record.flight.kept);
    EXPECT_EQ(machine.record.flight.memory_kb, 1024);
    EXPECT_EQ(machine.record.flight.files, 20);
    ASSERT_EQ(machine.axes.size(), 1U);
    EXPECT_EQ(machine.axes[0].max_decel_mm_s2, 1500);
}

TEST(MachineFile, TimeComesFromOneHostByDefault) {
    EXPECT_EQ(parse(kShortest).timing.time_source, TimeSource::Shared);
    const ProtocolTiming timing = parse(machine_with("timing { time_source: NETWORK slot_us: 4000 }")).timing;
    EXPECT_EQ(timing.time_source, TimeSource::Network);
    EXPECT_EQ(timing.clock_error_limit_us, 1000) << "the rest of a hop: a quarter of the slot";
    const auto ptp = machine_with("timing { time_source: PTP clock_error_limit_us: 5 }");
    EXPECT_EQ(parse(ptp).timing.clock_error_limit_us, 5);
    EXPECT_EQ(parse(machine_text(parse(ptp))).timing.time_source, TimeSource::Ptp);
}

/// On one host such a device has the only clock that is estimated.
TEST(MachineFile, ADeviceWithItsOwnClockHasAClockErrorLimit) {
    const MachineSetup machine =
        parse(axis_with("device: \"uio:/dev/uio0\"") + "timing { slot_us: 4000 clock_error_limit_us: 400 }");
    EXPECT_EQ(machine.axes[0].device, (DeviceName{DeviceName::Kind::Mapped, "/dev/uio0"}));
    const MachineSetup again = parse(machine_text(machine));
    EXPECT_EQ(again.timing.time_source, TimeSource::Shared);
    EXPECT_EQ(again.timing.clock_error_limit_us, 400);
    EXPECT_EQ(again.axes[0].device, machine.axes[0].device);
}

TEST(MachineFile, AnAxisHasASafeHeightOnlyIfItIsGiven) {
    const MachineSetup machine = parse(axis_with("safe_height_mm: 40"));
    EXPECT_EQ(machine.axes.at(0).safe_height_mm, 40);
    EXPECT_EQ(parse(machine_text(machine)).axes.at(0).safe_height_mm, 40);
    EXPECT_NE(config_hash(machine), config_hash(parse(kShortest)));
    EXPECT_FALSE(parse(kShortest).axes.at(0).safe_height_mm);
}

TEST(MachineFile, JogsHoldForTwentyMillisecondsAndNotUnhomedUnlessItSaysSo) {
    const MachineSetup usual = parse(kShortest);
    EXPECT_EQ(usual.timing.jog_hold_us, 20'000);
    EXPECT_FALSE(usual.axes.at(0).unhomed_jog_mm_s);
    const MachineSetup slow = parse(axis_with("unhomed_jog_mm_s: 2.5"));
    EXPECT_EQ(parse(machine_text(slow)).axes.at(0).unhomed_jog_mm_s, 2.5);
    const MachineSetup patient = parse(machine_with("timing { jog_hold_ms: 60 }"));
    EXPECT_EQ(parse(machine_text(patient)).timing.jog_hold_us, 60'000);
    EXPECT_EQ(config_hash(parse(machine_with("timing { jog_hold_ms: 20 }"))), config_hash(usual));
}

TEST(MachineFile, RingsHaveTheUsualSizesUnlessItSaysSo) {
    const MachineSetup usual = parse(std::string(kShortest));
    EXPECT_EQ(config_hash(parse(machine_with("timing { segment_entries: 1024 output_entries: 1024 }"))),
              config_hash(usual));
    const MachineSetup small = parse(machine_with("timing { segment_entries: 224 output_entries: 40 }"));
    EXPECT_EQ(small.timing.segment_entries, 224);
    EXPECT_EQ(parse(machine_text(small)).timing.output_entries, 40);
}

/// docs/pico.md and sim_fpga/rtl/README.md name these.
TEST(MachineFile, SmallRingsHaveRoomForOutputs) {
    const std::string air = "output { name: \"air\" motor: \"X\" channel: 0 use: MIST }\n";
    const std::string power =
        "output { name: \"power\" motor: \"X\" channel: 0 use: SPINDLE pwm { hz: 5000 full_scale: 1000 } }";
    EXPECT_TRUE(parse_machine(machine_with("timing { output_entries: 64 }\n" + air)));
    EXPECT_TRUE(parse_machine(machine_with("timing { output_entries: 64 frame_slots: 11 }\n" + air + power)));
    EXPECT_TRUE(
        parse_machine(machine_with("timing { frame_slots: 16 segment_entries: 192 output_entries: 24 }\n" + air)));
}

TEST(MachineFile, WordsForMissingDevicesAreRefusedExceptCoolant) {
    EXPECT_EQ(parse(kShortest).unassigned, UnassignedWords{});
    const MachineSetup machine = parse(machine_with("unassigned { spindle: IGNORE coolant: REFUSE }"));
    EXPECT_EQ(machine.unassigned.spindle, WordRule::Ignore);
    EXPECT_EQ(machine.unassigned.outputs, WordRule::Refuse);
    EXPECT_EQ(machine.unassigned.inputs, WordRule::Refuse);
    EXPECT_EQ(machine.unassigned.coolant, WordRule::Refuse);
    EXPECT_EQ(parse(machine_text(machine)).unassigned, machine.unassigned);
}

TEST(MachineFile, ThePageIsServedToThisHostAloneUnlessConfigured) {
    EXPECT_FALSE(parse(kShortest).web);
    const MachineSetup machine = parse(machine_with("web { }"));
    EXPECT_EQ(machine.web, WebConfig{});
    EXPECT_EQ(machine.web->address, "127.0.0.1");
    EXPECT_EQ(config_hash(machine), config_hash(parse(kShortest))) << "the page is no part of the machine";
    EXPECT_TRUE(parse(machine_with("web { address: \"127.9.9.9\" }")).web);
    EXPECT_TRUE(parse(machine_with("web { address: \"::1\" }")).web);
    const std::string files = " certificate_file: \"/a.crt\" key_file: \"/a.key\" host_names: \"mill\" }";
    const MachineSetup open = parse(machine_with("web { address: \"::\" port: 443" + files));
    EXPECT_EQ(open.web, (WebConfig{"::", 443, "/a.crt", "/a.key", {"mill"}}));
    EXPECT_EQ(parse(machine_text(open)).web, open.web);
}

TEST(MachineFile, HomingDefaultsFollowTheAxis) {
    const HomingConfig homing = parse(kShortest).axes.at(0).homing;
    EXPECT_TRUE(homing.toward_min);
    EXPECT_EQ(homing.search_velocity_mm_s, 10);
    EXPECT_EQ(homing.latch_velocity_mm_s, 2);
    EXPECT_EQ(homing.pulloff_mm, 2);
    EXPECT_EQ(homing.touch_tolerance_mm, 0.02);
    EXPECT_EQ(homing.switch_position_mm, 0);
    EXPECT_EQ(homing.park_mm, 0);
    const HomingConfig upward = parse(axis_with("homing { toward_min: false }")).axes.at(0).homing;
    EXPECT_EQ(upward.switch_position_mm, 200);
    EXPECT_EQ(parse(with("min_mm: 0", "min_mm: 50")).axes.at(0).homing.park_mm, 50);
    EXPECT_EQ(config_hash(parse(kShortest)), config_hash(parse(axis_with("homing { park_mm: 0 }"))));
    EXPECT_EQ(parse(with("max_mm: 200", "max_mm: 10")).axes.at(0).homing.pulloff_mm, 1);
}

TEST(MachineFile, ParksBesideTheSwitchWhereZeroIsAtTheOtherEndOfTravel) {
    const auto park = [](const std::string& homing, const std::string& min, const std::string& max) {
        std::string text = axis_with(homing);
        text.replace(text.find("position_min_mm: 0"), 18, "position_min_mm: " + min);
        text.replace(text.find("position_max_mm: 200"), 20, "position_max_mm: " + max);
        return parse(text).axes.at(0).homing.park_mm;
    };
    EXPECT_EQ(park("homing { toward_min: false }", "0", "200"), 198);
    EXPECT_EQ(park("homing { toward_min: false pulloff_mm: 5 switch_position_mm: 201 }", "0", "200"), 196);
    EXPECT_EQ(park("homing { toward_min: false }", "-200", "0"), 0) << "zero is at the switch";
    EXPECT_EQ(park("homing { toward_min: true }", "-200", "0"), -198);
    EXPECT_EQ(park("homing { toward_min: true }", "-200", "200"), 0);
}

TEST(MachineFile, OwnMovesUseTheNamedMethod) {
    EXPECT_EQ(parse(kShortest).axes.at(0).method, StepMethod::Ranade);
    EXPECT_EQ(parse(axis_with("method: RANADE")).axes.at(0).method, StepMethod::Ranade);
    EXPECT_EQ(parse(axis_with("method: SPIELAUER")).axes.at(0).method, StepMethod::Spielauer);
    EXPECT_EQ(parse(axis_with("method: CARRICA")).axes.at(0).method, StepMethod::Carrica);
    EXPECT_EQ(parse(with("150", "50", axis_with("method: LAI"))).axes.at(0).method, StepMethod::Lai);
    EXPECT_EQ(parse(with("10\n  max_velocity_mm_s: 150", "14\n  max_velocity_mm_s: 20", axis_with("method: LAM")))
                  .axes.at(0)
                  .method,
              StepMethod::Lam);
}

TEST(MachineFile, PlantDefaultsLeaveTheMotorAReserve) {
    const PlantConfig plant = parse(axis_with("max_decel_mm_s2: 2000")).axes.at(0).plant;
    EXPECT_EQ(plant.start_position_mm, 100);
    EXPECT_EQ(plant.travel_margin_mm, 2);
    EXPECT_EQ(plant.max_torque_accel_mm_s2, 3000);
    EXPECT_EQ(plant.max_jump_mm_s, 15);
}

TEST(MachineFile, ZeroIsAValueAndNotAnAbsence) {
    const MachineSetup machine = parse(axis_with("plant { start_position_mm: 0 }"));
    EXPECT_EQ(machine.axes.at(0).plant.start_position_mm, 0);
}

TEST(MachineFile, ItsTextGivesTheSameMachineBack) {
    for (const auto& text :
         {std::string(kShortest), with("80", "53.333333333333336"), machine_with("tick_ns: 250"),
          machine_with("record { own_logs: false directory: \"/tmp/x\" size_limit_mb: 7 }"),
          machine_with("security { directory: \"/etc/lockstep/keys\" }"),
          machine_with("record { flight { kept: false memory_kb: 64 files: 3 } }"),
          machine_with("network { peers: \"10.0.0.1\" peers: \"mill-x\" }"), machine_with("network { one_host: true }"),
          axis_with("homing { toward_min: false park_mm: 0.1 }"), axis_with("method: SPIELAUER"),
          axis_with("method: CARRICA"), machine_with("unassigned { inputs: IGNORE }"),
          machine_with("subroutine_directory: \"/srv/subroutines\""), machine_with("web { }"),
          machine_with("web { address: \"0.0.0.0\" port: 443 certificate_file: \"/a.crt\" key_file: \"/a.key\" "
                       "host_names: \"mill\" host_names: \"mill.example\" }")}) {
        const MachineSetup machine = parse(text);
        EXPECT_EQ(machine_text(parse(machine_text(machine))), machine_text(machine));
        EXPECT_EQ(config_hash(parse(machine_text(machine))), config_hash(machine));
    }
}

TEST(MachineFile, TheHashDependsOnTheMeaningNotOnTheText) {
    const std::uint64_t hash = config_hash(parse(kShortest));
    EXPECT_NE(hash, 0U);
    EXPECT_EQ(config_hash(parse("# a comment\n" + machine_with("tick_ns: 1000"))), hash);
    EXPECT_EQ(config_hash(parse(axis_with("max_decel_mm_s2: 1.5e3"))), hash);
    EXPECT_NE(config_hash(parse(with("150", "150.00000000000003"))), hash);
    EXPECT_NE(config_hash(parse(axis_with("homing { park_mm: 1 }"))), hash);
}

TEST(MachineFile, TheHashIsTheSameOnEveryHost) { EXPECT_EQ(config_hash(parse(kShortest)), 14268460011038206234U); }

TEST(MachineFile, AnUnattendedJobRunsOnUnlessTheFileSaysOtherwise) {
    const MachineSetup usual = parse(kShortest);
    EXPECT_EQ(usual.unattended_job, UnattendedJob::RunsOn);
    EXPECT_EQ(config_hash(parse(machine_with("unattended_job: RUN_ON"))), config_hash(usual));
    const MachineSetup held = parse(machine_with("unattended_job: BE_HELD"));
    EXPECT_EQ(held.unattended_job, UnattendedJob::IsHeld);
    EXPECT_EQ(parse(machine_text(held)).unattended_job, UnattendedJob::IsHeld);
    EXPECT_NE(config_hash(held), config_hash(usual));
}

TEST(MachineFile, MethodsHaveTheSameNumbersInFilesAndInCore) {
    for (int number = 0; number < proto::Method_ARRAYSIZE; ++number) {
        std::string name(name_of(static_cast<StepMethod>(number)));
        for (char& c : name) { c = static_cast<char>(std::toupper(c)); }
        EXPECT_EQ(name, proto::Method_Name(number));
    }
}

}  // namespace
}  // namespace lockstep
