// The log has one line per event, with its service, axis and code.
#include "services/runtime/log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace lockstep {
namespace {

TEST(Log, ALineSaysWhenWhoWhatAndWhichCode) {
    const auto path = std::filesystem::temp_directory_path() / ("lockstep_service_log_" + std::to_string(getpid()));
    ASSERT_TRUE(open_log({.service = "axis", .axis = "X", .file = path}));
    log_event(spdlog::level::warn, FaultCode::LimitHit, "at 100 % of {travel}");
    std::ifstream file(path);
    std::string line;
    std::getline(file, line);
    ASSERT_GT(line.size(), 24u);
    EXPECT_EQ(line[10], 'T') << line;  // 2025-01-31T12:00:00.123Z
    EXPECT_EQ(line[23], 'Z') << line;
    EXPECT_EQ(line.substr(24), " warning axis X limit-hit at 100 % of {travel}");
    std::filesystem::remove(path);
    ASSERT_TRUE(open_log({.service = "test", .axis = ""}));
}

TEST(Log, AFileThatCannotBeWrittenIsNamed) {
    const auto opened = open_log({.service = "axis", .axis = "X", .file = "/nonexistent/log"});
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().find("/nonexistent/log"), std::string::npos);
}

}  // namespace
}  // namespace lockstep
