// A log in the background never delays its process, and lost lines are counted and reported.
#include <gtest/gtest.h>
#include <spdlog/sinks/base_sink.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <filesystem>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "services/runtime/background_sink.hpp"
#include "services/runtime/line_queue.hpp"
#include "services/runtime/log.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
using Queue = LineQueue<4>;

bool add(Queue& queue, const std::string& text) { return queue.add({}, 0, text); }

std::vector<std::string> take_all(Queue& queue) {
    std::vector<std::string> lines;
    while (queue.take([&](const LogLine& line) { lines.emplace_back(line.view()); })) {}
    return lines;
}

TEST(LineQueue, GivesLinesInTheirOrder) {
    Queue queue;
    for (const char* text : {"a", "b", "c"}) { EXPECT_TRUE(add(queue, text)); }
    EXPECT_EQ(take_all(queue), (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_TRUE(queue.is_empty());
}

TEST(LineQueue, DropsAndCountsLinesWhenFull) {
    Queue queue;
    for (int round = 0; round < 3; ++round) {
        for (int i = 0; i < 6; ++i) { EXPECT_EQ(add(queue, std::to_string(i)), i < 4); }
        EXPECT_EQ(take_all(queue), (std::vector<std::string>{"0", "1", "2", "3"}));
    }
    EXPECT_EQ(queue.dropped(), 6U);
}

TEST(LineQueue, CutsLinesThatAreTooLong) {
    Queue queue;
    add(queue, std::string(5000, 'x'));
    EXPECT_EQ(take_all(queue), std::vector{std::string(LogLine::kMaxBytes, 'x')});
}

TEST(LineQueue, LosesNoLineWithManyWriters) {
    constexpr std::size_t kThreads = 4;
    constexpr int kLines = 20'000;
    auto queue = std::make_unique<LineQueue<64>>();
    std::array<int, kThreads> newest;
    newest.fill(-1);
    std::uint64_t taken = 0;
    const auto use = [&](const LogLine& line) {
        const auto thread = static_cast<std::size_t>(line.level);
        const int number = std::stoi(std::string(line.view()));
        EXPECT_GT(number, newest[thread]);
        newest[thread] = number;
        ++taken;
    };
    {
        std::vector<std::jthread> threads;
        for (std::size_t t = 0; t < kThreads; ++t) {
            threads.emplace_back([&, t] {
                for (int i = 0; i < kLines; ++i) { (void)queue->add({}, static_cast<int>(t), std::to_string(i)); }
            });
        }
        while (taken + queue->dropped() < kThreads * kLines) { (void)queue->take(use); }
    }
    EXPECT_TRUE(queue->is_empty());
}

/// A disk that hangs until it is released.
class HungDisk final : public spdlog::sinks::base_sink<std::mutex> {
public:
    void let_go() {
        hangs_ = false;
        hangs_.notify_all();
    }
    bool hangs() const { return hangs_; }
    std::vector<std::string> lines;

private:
    void sink_it_(const spdlog::details::log_msg& message) override {
        hangs_.wait(true);
        lines.emplace_back(message.payload.data(), message.payload.size());
    }
    void flush_() override {}
    std::atomic<bool> hangs_ = true;
};

TEST(BackgroundSink, NeverWaitsForADiskThatHangsAndReportsWhatIsLost) {
    const auto disk = std::make_shared<HungDisk>();
    {
        BackgroundSink sink(disk);
        for (int i = 0; i < 1000; ++i) { sink.log({"", spdlog::level::info, std::to_string(i)}); }
        EXPECT_EQ(sink.lost(), 1000U - 256U);
        disk->let_go();
        sink.drain(20s);
    }
    ASSERT_EQ(disk->lines.size(), 257U);
    EXPECT_EQ(disk->lines[255], "255");
    EXPECT_EQ(disk->lines[256], "- 744 lines of this log are lost: they could not be written in time");
}

TEST(BackgroundSink, EndsThoughItsDiskHangs) {
    const auto disk = std::make_shared<HungDisk>();
    {
        BackgroundSink sink(disk);
        sink.log({"", spdlog::level::info, "a line"});
    }
    EXPECT_TRUE(disk->hangs()) << "its end waited for the disk";
    disk->let_go();
}

TEST(Log, InTheBackgroundIsWholeAtItsEnd) {
    const auto path = std::filesystem::temp_directory_path() / ("lockstep_background_" + std::to_string(getpid()));
    ASSERT_TRUE(open_log({.service = "axis", .axis = "X", .file = path, .in_background = true}));
    for (int i = 0; i < 200; ++i) { log_info(std::to_string(i)); }
    EXPECT_EQ(lost_log_lines(), 0U);
    ASSERT_TRUE(open_log({.service = "test", .axis = ""}));
    std::ifstream file(path);
    int lines = 0;
    for (std::string line; std::getline(file, line); ++lines) {
        EXPECT_TRUE(line.ends_with(" info axis X - " + std::to_string(lines))) << line;
    }
    EXPECT_EQ(lines, 200);
    std::filesystem::remove(path);
}

}  // namespace
}  // namespace lockstep
