// A fault puts the notes into a file that LCM's tools read. The number of files is limited.
#include "services/flight/incident_file.hpp"

#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>

#include "services/flight/flight_recorder.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "tests/unit/flight/flight_makers.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;

struct Read {
    std::vector<flight_head_t> heads;
    std::vector<flight_event_t> events;
};

Read read_file(const fs::path& path) {
    Read read;
    auto log = LogReader::open(path).value();
    while (const auto event = log.next().value()) {
        if (const auto head = decode_lcm<flight_head_t>(event->data)) { read.heads.push_back(*head); }
        if (const auto noted = decode_lcm<flight_event_t>(event->data)) { read.events.push_back(*noted); }
    }
    return read;
}

class IncidentFile : public FlightFolder {
protected:
    fs::path write(std::int64_t wall_us, const std::string& process = "axis-X") {
        return write_incident({source(process), {{1, noted(5)}}}, {IncidentReason::Veto, Tick{5}, wall_us}).value();
    }
};

TEST_F(IncidentFile, NamesItsProcessAndReason) {
    const Read read = read_file(write(1'700'000'000'123'000));
    ASSERT_EQ(read.heads.size(), 1U);
    EXPECT_EQ(read.heads[0].process, "axis-X");
    EXPECT_EQ(read.heads[0].reason, "veto");
    EXPECT_EQ(read.heads[0].tick, 5);
    ASSERT_EQ(read.events.size(), 1U);
    EXPECT_EQ(read.events[0].what, "frame-armed");
    EXPECT_EQ(read.events[0].frame, 5);
}

TEST_F(IncidentFile, HasTheLastTenSeconds) {
    constexpr std::int64_t kSecond = 1'000'000;
    FlightSnapshot snapshot{source(), {}};
    for (std::int64_t i = 1; i <= 30; ++i) {
        snapshot.events.push_back({static_cast<std::uint64_t>(i), noted(i * kSecond)});
    }
    const auto file = write_incident(snapshot, {IncidentReason::Fault, Tick{28 * kSecond}, 1});
    const Read read = read_file(*file);
    EXPECT_EQ(read.events.front().tick, 18 * kSecond);
    EXPECT_EQ(read.events.back().tick, 30 * kSecond) << "the aftermath, too";
}

TEST_F(IncidentFile, ReplacesTheOldestOfTheSameProcess) {
    const fs::path other = write(1, "axis-XY");
    for (std::int64_t i = 2; i < 9; ++i) { write(i * 1'000'000); }
    const auto files = incident_files(folder / "incidents");
    EXPECT_EQ(files.size(), 4U) << "three of this process";
    EXPECT_THAT(files, testing::Contains(other));
    EXPECT_THAT(files.back().filename().string(), testing::HasSubstr("T000008"));
}

TEST_F(IncidentFile, ReportsAnImpossibleDirectoryWithTheRemedy) {
    FlightSource in_the_way = source();
    std::ofstream(folder / "file") << "a file";
    in_the_way.directory = folder / "file" / "below";
    const auto file = write_incident({in_the_way, {}}, {});
    ASSERT_FALSE(file);
    EXPECT_THAT(file.error(), testing::HasSubstr("record { directory }"));
}

TEST_F(IncidentFile, EveryKindOfEventComesBack) {
    MachineSetup machine{{.name = "mill"}};
    for (const char* name : {"X", "Y"}) { machine.axes.push_back({.name = name}); }
    for (int kind = 0; kind <= static_cast<int>(FlightKind::StepsCorrected); ++kind) {
        const NumberedEvent event{3,
                                  {.tick = Tick{12},
                                   .kind = static_cast<FlightKind>(kind),
                                   .about = kind % 2 == 0 ? flight_axis(MotorIndex{1}) : kFlightCoordinator,
                                   .detail = 4,
                                   .fault = FaultCode::AxisLost,
                                   .epoch = 8,
                                   .frame = 9,
                                   .count = -7,
                                   .amount = 1.5,
                                   .lasts = {125}}};
        const auto back = from_lcm(to_lcm(source(), machine, event), machine);
        ASSERT_TRUE(back) << back.error();
        EXPECT_EQ(*back, event);
    }
}

TEST_F(IncidentFile, RefusesADetailThatNoEventHas) {
    const MachineSetup machine{{.name = "mill"}};
    flight_event_t message = to_lcm(source(), machine, {1, noted(5)});
    for (const std::int32_t detail : {-1, 256}) {
        message.detail = detail;
        const auto back = from_lcm(message, machine);
        ASSERT_FALSE(back);
        EXPECT_THAT(back.error(), testing::HasSubstr(std::to_string(detail)));
    }
}

class Recorder : public FlightFolder {
protected:
    std::unique_ptr<FlightRecorder> begin() { return FlightRecorder::open(rings(), source(), 100).value(); }
    std::vector<fs::path> files() const { return incident_files(folder / "incidents"); }
};

TEST_F(Recorder, WritesNothingWithoutAnIncident) {
    begin()->add(noted(1));
    EXPECT_TRUE(files().empty());
}

TEST_F(Recorder, WritesAnIncidentAtTheLatestWhenItsProcessEnds) {
    auto recorder = begin();
    recorder->add(noted(1));
    recorder->incident(Tick{2}, IncidentReason::OwnerLost);
    recorder->add(noted(3));
    recorder.reset();
    ASSERT_EQ(files().size(), 1U);
    const Read read = read_file(files()[0]);
    EXPECT_EQ(read.heads.at(0).reason, "owner-lost");
    EXPECT_EQ(read.heads.at(0).tick, 2);
    EXPECT_EQ(read.events.size(), 3U) << "and the aftermath";
}

TEST_F(Recorder, SavesTheNotesOfAKilledProcess) {
    const pid_t child = fork();
    if (child == 0) {
        FlightRing ring = FlightRing::create(rings(), source(), 10).value();
        ring.add(noted(42));
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    begin().reset();  // the successor of the killed process
    ASSERT_EQ(files().size(), 1U);
    EXPECT_EQ(read_file(files()[0]).heads.at(0).reason, "ended");
    EXPECT_EQ(read_file(files()[0]).events.at(0).frame, 42);
    EXPECT_TRUE(rings_in(rings()).empty());
}

TEST_F(Recorder, LeavesFilesOfOtherMachines) {
    const pid_t child = fork();
    if (child == 0) {
        FlightSource other = source();
        other.directory = folder / "other";
        FlightRing ring = FlightRing::create(rings(), other, 10).value();
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    begin().reset();
    EXPECT_EQ(rings_in(rings()).size(), 1U);
}

}  // namespace
}  // namespace lockstep
