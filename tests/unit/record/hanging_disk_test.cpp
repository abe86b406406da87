// A service whose record or flight goes to a disk that hangs still ends on request.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "services/record/queued_sink.hpp"
#include "services/runtime/end_guard.hpp"
#include "services/runtime/service_options.hpp"

namespace lockstep {
namespace {

/// Opening a FIFO without a reader never returns.
class Fifo final : public RecordSink {
public:
    void write(const std::string& /*channel*/, std::int64_t /*utime*/, std::span<const std::uint8_t> bytes) override {
        const auto path = std::filesystem::path(testing::TempDir()) / ("lockstep-fifo-" + std::to_string(getpid()));
        (void)mkfifo(path.c_str(), 0600);
        std::ofstream(path).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
    }
};

[[noreturn]] void end_while_the_disk_hangs() {
    StopSignal stop;
    const EndGuard guard(stop, std::chrono::milliseconds{200});
    {
        QueuedSink record(std::make_unique<Fifo>(), [](RecordSink&, const RecordLoss&) {});
        record.write("LOCKSTEP_MILL_X_STEPS", 1, std::vector<std::uint8_t>(10));
        raise(SIGTERM);
    }
    std::_Exit(kServiceDone);
}

TEST(HangingDisk, DoesNotKeepAServiceFromEnding) {
    GTEST_FLAG_SET(death_test_style, "threadsafe");
    EXPECT_EXIT(end_while_the_disk_hangs(), testing::ExitedWithCode(kServiceFailed), "a disk may hang");
}

}  // namespace
}  // namespace lockstep
