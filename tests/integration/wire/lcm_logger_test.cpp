// Published messages are in the log of LCM's own logger, on real multicast, read by our reader.
#include <gtest/gtest.h>

#include <filesystem>

#include "services/network/multicast.hpp"
#include "services/record/step_batcher.hpp"
#include "services/wire/lcm/lcm_channels.hpp"
#include "services/wire/lcm/lcm_decode.hpp"
#include "services/wire/lcm/lcm_log.hpp"
#include "services/wire/lcm/lcm_publisher.hpp"
#include "tests/integration/wire/child.hpp"
#include "tests/integration/wire/eventually.hpp"
#include "tests/integration/wire/own_network.hpp"

namespace lockstep {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

class Logger : public testing::Test {
protected:
    Logger() : publisher_(LcmPublisher::open(network_)) {}
    ~Logger() override { fs::remove(file_); }

    void SetUp() override {
        ASSERT_TRUE(publisher_) << publisher_.error();
        ASSERT_TRUE(eventually([&] {  // it receives once its file is not empty
            publisher_->publish("PROBE", axis_position_t{});
            return fs::exists(file_) && fs::file_size(file_) > 0;
        }));
    }

    NetworkConfig network_ = own_network();
    fs::path file_ = fs::temp_directory_path() / ("lockstep_lcm_log_" + std::to_string(getpid()));
    Child logger_ =
        Child::execute({"lcm-logger", "--quiet", "--force", "--lcm-url=" + network_.lcm_url, file_.string()});
    std::expected<LcmPublisher, std::string> publisher_;
};

TEST_F(Logger, EveryStepPublishedIsInTheLog) {
    const std::string channel = channels_of("mill", "X").steps;
    StepBatcher batcher({.machine = "mill", .axis = "X"}, 0,
                        [&](const step_batch_t& batch) { EXPECT_TRUE(publisher_->publish(channel, batch)); });
    for (std::int64_t tick = 0; tick < 500'000; tick += 10) {  // 100,000 steps a second for half a second
        batcher.add({{tick}, 1});
        batcher.poll({tick});
        if (tick % 10'000 == 0) { std::this_thread::sleep_for(10ms); }
    }
    batcher.flush();
    std::this_thread::sleep_for(500ms);  // the logger takes the messages in its socket, then is ended
    logger_.signal(SIGINT);
    EXPECT_EQ(logger_.wait(), 0);

    auto log = LogReader::open(file_);
    ASSERT_TRUE(log) << log.error();
    std::int64_t sequence = 0;
    std::int64_t steps = 0;
    while (const auto event = log->next().value()) {
        if (event->channel != channel) { continue; }
        const auto batch = decode_lcm<step_batch_t>(event->data);
        ASSERT_TRUE(batch) << batch.error();
        EXPECT_EQ(batch->sequence, sequence++);
        EXPECT_EQ(batch->position_before, steps);
        steps += batch->count;
    }
    EXPECT_EQ(steps, 50'000);
    EXPECT_EQ(log->damaged_bytes(), 0u);
}

TEST(Publisher, RefusesToSendAgainstTheRoute) {
    NetworkConfig network = own_network();
    EXPECT_TRUE(check_multicast(network));
    network.interface = "eth7";
    network.lcm_url = "udpm://239.255.76.67:7667?ttl=1";
    EXPECT_FALSE(LcmPublisher::open(network));
    network.lcm_url = "";
    EXPECT_FALSE(LcmPublisher::open(network));
}

}  // namespace
}  // namespace lockstep
