// A flight source, its rings and its incident files in a temporary folder, for tests.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "services/documents/machine_file.hpp"
#include "services/flight/flight_source.hpp"
#include "tests/temporary_directory.hpp"

namespace lockstep {

class FlightFolder : public testing::Test {
protected:
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

    TemporaryDirectory directory;
    std::filesystem::path folder = directory.path();
};

inline FlightEvent noted(std::int64_t tick, FlightKind kind = FlightKind::FrameArmed) {
    return {.tick = Tick{tick}, .kind = kind, .frame = static_cast<FrameNumber>(tick)};
}

}  // namespace lockstep
