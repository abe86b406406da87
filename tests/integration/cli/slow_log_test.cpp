// The disk of the logs hangs: the machine works as exactly as before, and the lost lines are reported.
#include <fcntl.h>
#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <memory>
#include <vector>

#include "services/documents/machine_file.hpp"
#include "tests/integration/cli/own_machine.hpp"
#include "tests/integration/cli/reset_client.hpp"
#include "tests/integration/wire/eventually.hpp"

namespace lockstep {
namespace {

using testing::HasSubstr;

/// A file for a log that takes a page and then hangs until it is read.
class HungFile {
public:
    explicit HungFile(std::filesystem::path path) : path_(std::move(path)) {
        mkfifo(path_.c_str(), 0600);
        file_ = open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
        fcntl(file_, F_SETPIPE_SZ, 4096);
    }
    HungFile(const HungFile&) = delete;
    HungFile& operator=(const HungFile&) = delete;
    ~HungFile() {
        std::filesystem::remove(path_);
        close(file_);
    }
    /// Reads everything that was written and waits.
    std::string read() const {
        std::array<char, 4096> bytes{};
        std::string text;
        for (ssize_t size = ::read(file_, bytes.data(), bytes.size()); size > 0;
             size = ::read(file_, bytes.data(), bytes.size())) {
            text.append(bytes.data(), static_cast<std::size_t>(size));
        }
        return text;
    }

private:
    std::filesystem::path path_;
    int file_ = -1;
};

class SlowLog : public OwnMachine {
protected:
    /// Each process writes its log into a file that hangs.
    void start() {
        const auto start_one = [&](const char* program, const std::string& name, Words words) {
            logs_.push_back(std::make_unique<HungFile>(folder() / (name + ".log")));
            words.insert(words.end(), {"--machine", file(), "--log", folder() / (name + ".log")});
            processes_.push_back(std::make_unique<ChildProcess>(program, words));
        };
        start_one(LOCKSTEP_COORDINATOR, "coordinator", {});
        for (const char* axis : {"X", "Y"}) { start_one(LOCKSTEP_AXIS, axis, {"--axis", axis}); }
    }

    std::vector<std::unique_ptr<HungFile>> logs_;
    std::vector<std::unique_ptr<ChildProcess>> processes_;  // destroyed before the logs
};

TEST_F(SlowLog, AJobIsExactWhileTheLogsHangAndLostLinesAreReported) {
    start();
    ASSERT_TRUE(becomes("Idle"));
    record();
    ASSERT_EQ(run_lockstep({"home"}).code, 0);
    constexpr int kResets = 900;  // each axis logs most of them: more lines than its log keeps in memory
    ASSERT_TRUE(reset_often(load_machine_file(file()).value(), kResets));
    const Ran job = run_lockstep({"run", write("job.gcode", kThereAndBack)});
    EXPECT_EQ(job.code, 0) << job.out << job.err;
    expect_verified();

    EXPECT_THAT(run_lockstep({"status"}).out, HasSubstr("log lines that could not be written: "));

    std::string logged;
    EXPECT_TRUE(eventually([&] {
        for (const auto& log : logs_) { logged += log->read(); }
        return logged.find(" lines of this log are lost: they could not be written in time") != logged.npos;
    })) << "the disk works again: "
        << logged;
    EXPECT_THAT(logged, HasSubstr("homed and parked"));
}

}  // namespace
}  // namespace lockstep
