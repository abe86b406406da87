// The log has one line per event, with its service, axis and code.
#include "services/runtime/log.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>

namespace lockstep {
namespace {

TEST(Log, ALineHasTimeServiceTextAndCode) {
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

TEST(Log, KeepsTheNewestFilesOfALongRun) {
    const auto directory = std::filesystem::temp_directory_path() / ("lockstep_long_log_" + std::to_string(getpid()));
    std::filesystem::create_directory(directory);
    ASSERT_TRUE(open_log({.service = "axis", .axis = "X", .file = directory / "axis-X.log"}));
    const std::string line(1000, 'x');
    const std::size_t lines = (kOlderLogFiles + 3) * kLogFileBytes / line.size();
    for (std::size_t i = 0; i < lines; ++i) { log_info(line); }
    log_info("the last line");
    ASSERT_TRUE(open_log({.service = "test", .axis = ""}));

    std::size_t files = 0;
    for (const auto& entry : std::filesystem::directory_iterator(directory)) {
        ++files;
        EXPECT_LE(entry.file_size(), kLogFileBytes) << entry.path();
    }
    EXPECT_EQ(files, 1 + kOlderLogFiles);
    EXPECT_TRUE(std::filesystem::exists(directory / "axis-X.1.log"));
    std::ifstream newest(directory / "axis-X.log");
    const std::string text{std::istreambuf_iterator<char>(newest), {}};
    EXPECT_TRUE(text.ends_with("the last line\n"));
    std::filesystem::remove_all(directory);
}

TEST(Log, AFileThatCannotBeWrittenIsNamed) {
    const auto opened = open_log({.service = "axis", .axis = "X", .file = "/nonexistent/log"});
    ASSERT_FALSE(opened);
    EXPECT_NE(opened.error().find("/nonexistent/log"), std::string::npos);
}

}  // namespace
}  // namespace lockstep
