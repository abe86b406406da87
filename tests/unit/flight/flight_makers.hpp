// A process's flight for tests, in a folder of its own.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "services/documents/machine_file.hpp"
#include "services/flight/flight_source.hpp"

namespace lockstep {

class FlightFolder : public testing::Test {
protected:
    FlightFolder() {
        std::filesystem::remove_all(folder);
        std::filesystem::create_directories(folder);
    }
    ~FlightFolder() override { std::filesystem::remove_all(folder.parent_path()); }

    FlightSource source(const std::string& process = "axis-X") const {
        return {.machine = "mill",
                .process = process,
                .incarnation = 7,
                .tick_ns = 1000,
                .config = "name: \"mill\"",
                .directory = folder / "incidents",
                .files = 3};
    }
    std::filesystem::path rings() const { return folder / "rings"; }

    // By process: two programs have these tests.
    std::filesystem::path folder = std::filesystem::path(testing::TempDir()) /
                                   ("lockstep_flight_" + std::to_string(getpid())) /
                                   testing::UnitTest::GetInstance()->current_test_info()->name();
};

inline FlightEvent noted(std::int64_t tick, FlightKind kind = FlightKind::FrameArmed) {
    return {.tick = Tick{tick}, .kind = kind, .frame = static_cast<FrameNumber>(tick)};
}

}  // namespace lockstep
