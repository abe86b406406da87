// Incident files are read as far as possible, combined by machine time, and evaluated even if some are missing.
#include <gmock/gmock.h>
#include <unistd.h>

#include <fstream>

#include "clients/incident/cause.hpp"
#include "clients/incident/incident_input.hpp"
#include "clients/incident/notes.hpp"
#include "clients/incident/sentences.hpp"
#include "services/documents/machine_file.hpp"
#include "services/flight/incident_file.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "tests/unit/virtual/rig.hpp"

namespace lockstep::incident {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

class IncidentFiles : public testing::Test {
protected:
    IncidentFiles() { fs::remove_all(folder); }
    ~IncidentFiles() override { fs::remove_all(folder); }

    /// The notes of axis X: it vetoed frame 17 at `tick` since it had received nothing from Y.
    fs::path write_veto(std::int64_t tick, std::int64_t wall_us = 1'000'000,
                        const MachineSetup& machine = small_machine()) const {
        const FlightSource source{.machine = "rig",
                                  .process = "axis-X",
                                  .incarnation = 7,
                                  .tick_ns = 1000,
                                  .config = machine_text(machine),
                                  .directory = folder,
                                  .files = 9};
        const std::vector<NumberedEvent> events{
            {1, {.tick = Tick{tick - 5'000}, .kind = FlightKind::FrameArmed, .frame = 16}},
            {2,
             {.tick = Tick{tick},
              .kind = FlightKind::Vetoed,
              .detail = static_cast<std::uint8_t>(VetoReason::NoEvidence),
              .frame = 17,
              .count = 0b10}},
            {3, {.tick = Tick{tick}, .kind = FlightKind::Incident, .detail = 1}}};
        return write_incident({source, events}, {IncidentReason::Veto, Tick{tick}, wall_us}).value();
    }

    fs::path folder = fs::path(testing::TempDir()) / "lockstep_incident" /
                      testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(IncidentFiles, AreReadAsWritten) {
    const auto file = read_flight_file(write_veto(2'000'000));
    ASSERT_TRUE(file) << file.error();
    EXPECT_EQ(file->head.source.process, "axis-X");
    EXPECT_EQ(file->machine.axes.size(), 2U);
    EXPECT_EQ(file->events.size(), 3U);
    EXPECT_TRUE(file->damages.empty());
}

TEST_F(IncidentFiles, ReportMissingPartsIfDamaged) {
    const fs::path path = write_veto(2'000'000);
    fs::resize_file(path, fs::file_size(path) - 10);
    const auto file = read_flight_file(path);
    ASSERT_TRUE(file) << file.error();
    EXPECT_EQ(file->events.size(), 2U);
    ASSERT_EQ(file->damages.size(), 1U);
    const auto incident = incidents_of({*file}).at(0);
    EXPECT_THAT(notes_of(incident), testing::Contains(HasSubstr("not read: " + path.string())));
}

TEST_F(IncidentFiles, DamagedAnywhereAreReadOrRefused) {
    const fs::path path = write_veto(2'000'000);
    std::ifstream in(path, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(in), {}};
    int refused = 0;
    int damaged = 0;
    for (std::size_t at = 0; at < whole.size(); at += 3) {
        std::string bytes = whole;
        bytes[at] = static_cast<char>(bytes[at] ^ 0xFF);
        std::ofstream(path, std::ios::binary) << bytes;
        const auto file = read_flight_file(path);
        if (!file) {
            EXPECT_FALSE(file.error().empty());
            ++refused;
            continue;
        }
        const auto incident = incidents_of({*file}).at(0);
        (void)evaluate(incident);
        if (file->damages.empty()) { continue; }
        ++damaged;
        EXPECT_THAT(notes_of(incident), testing::Contains(HasSubstr("not read: ")));
    }
    EXPECT_GT(refused, 0);
    EXPECT_GT(damaged, 0);
}

TEST_F(IncidentFiles, OfOtherContentAreRefused) {
    fs::create_directories(folder);
    std::ofstream(folder / "notes.txt") << "something else";
    EXPECT_THAT(read_flight_file(folder / "notes.txt").error(), HasSubstr("contains no notes of a flight recorder"));
    EXPECT_THAT(read_flight_file(folder / "none").error(), HasSubstr((folder / "none").string()));
}

TEST_F(IncidentFiles, InADirectoryThatTheUserMayNotReadAreNotReportedAsAbsent) {
    if (geteuid() != 0) { GTEST_SKIP() << "only root can act as another user"; }
    write_veto(2'000'000);
    fs::permissions(folder, fs::perms::owner_all);
    ASSERT_EQ(seteuid(65534), 0);
    const auto input = read_incidents({folder});
    ASSERT_EQ(seteuid(0), 0);
    ASSERT_FALSE(input);
    EXPECT_EQ(input.error(), folder.string() + ": this user may not read it; only its owner root may");
}

TEST_F(IncidentFiles, FarApartAreDifferentIncidents) {
    const auto first = read_flight_file(write_veto(2'000'000, 1'000'000)).value();
    const auto soon = read_flight_file(write_veto(9'000'000, 8'000'000)).value();
    const auto later = read_flight_file(write_veto(60'000'000, 59'000'000)).value();
    const auto after_a_reboot = read_flight_file(write_veto(2'500'000, 1'000'000'000'000)).value();
    const auto incidents = incidents_of({later, after_a_reboot, first, soon});
    ASSERT_EQ(incidents.size(), 3U);
    EXPECT_EQ(incidents[0].processes.at(0).files.size(), 2U) << "two files of one process, soon after each other";
    EXPECT_EQ(incidents[1].timeline.back().tick, Tick{60'000'000});
    EXPECT_EQ(incidents[2].timeline.back().tick, Tick{2'500'000});
}

TEST_F(IncidentFiles, TheSameTwiceCountsOnce) {
    const auto file = read_flight_file(write_veto(2'000'000)).value();
    EXPECT_EQ(incidents_of({file, file}).at(0).timeline.size(), 3U);
}

TEST_F(IncidentFiles, NameMotorsThatAreNotTheOnlyOnesOfTheirAxis) {
    MachineSetup machine = small_machine();
    for (const char* name : {"Y1", "Y2"}) {
        machine.axes[1].motors.push_back({.name = name,
                                          .device = machine.axes[1].device,
                                          .steps_per_mm = machine.axes[1].steps_per_mm,
                                          .plant = {}});
    }
    machine.axes[1].max_skew_mm = 10;
    const auto file = read_flight_file(write_veto(2'000'000, 1'000'000, machine));
    ASSERT_TRUE(file) << file.error();
    const auto incident = incidents_of({*file}).at(0);
    EXPECT_THAT(incident.absent, ElementsAre("coordinator", "motor Y1", "motor Y2"));
    EXPECT_EQ(incident.processes.at(0).name, "axis X");
    EXPECT_EQ(evaluate(incident).story[1],
              "axis X vetoes frame 17: no recent state of motor Y1 reports that the frame is held");
}

TEST_F(IncidentFiles, NameAProcessWithoutFileAndTheRemedy) {
    const auto incident = incidents_of({read_flight_file(write_veto(2'000'000)).value()}).at(0);
    EXPECT_THAT(incident.absent, ElementsAre("coordinator", "axis Y"));
    const Evaluation evaluation = evaluate(incident);
    EXPECT_EQ(evaluation.cause.kind, CauseKind::Unknown);
    EXPECT_THAT(evaluation.story[0], HasSubstr("axis Y left no file here; lockstep flight"));
    EXPECT_EQ(evaluation.story[1], "axis X vetoes frame 17: no recent state of axis Y reports that the frame is held");
}

}  // namespace
}  // namespace lockstep::incident
