// Real services allocate nothing in their loops while a job runs, is held and resumed. So they do not wait for the
// allocator or the kernel. Allocations by libraries that they call are counted separately.
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <map>
#include <memory>
#include <thread>

#include "tests/integration/cli/allocations/allocation_count.hpp"
#include "tests/integration/cli/own_machine.hpp"

namespace lockstep {
namespace {

/// The count of one running process.
class WatchedProcess {
public:
    WatchedProcess(const std::filesystem::path& directory, pid_t process) {
        const int file = open((directory / std::to_string(process)).c_str(), O_RDONLY | O_CLOEXEC);
        void* memory = mmap(nullptr, sizeof(AllocationCount), PROT_READ, MAP_SHARED, file, 0);
        close(file);
        if (memory != MAP_FAILED) { count_ = static_cast<const AllocationCount*>(memory); }
    }
    WatchedProcess(const WatchedProcess&) = delete;
    WatchedProcess& operator=(const WatchedProcess&) = delete;
    ~WatchedProcess() {
        if (count_ != nullptr) { munmap(const_cast<AllocationCount*>(count_), sizeof(AllocationCount)); }
    }

    bool is_watched() const { return count_ != nullptr && count_->own > 0; }
    std::uint64_t other() const { return count_->other; }
    /// The number of calls by place.
    std::map<std::uint64_t, std::uint64_t> places() const {
        std::map<std::uint64_t, std::uint64_t> calls;
        for (const auto& place : count_->places) {
            if (place.address != 0) { calls[place.address] = place.calls; }
        }
        return calls;
    }

private:
    const AllocationCount* count_ = nullptr;
};

/// More than twice the time of the frames that a coordinator keeps: until then its queues grow.
constexpr std::chrono::seconds kWarmUp{8};

class LoopAllocations : public OwnMachine {
protected:
    void bring_up_watched() {
        counts_ = folder() / "allocations";
        std::filesystem::create_directory(counts_);
        setenv("LD_PRELOAD", LOCKSTEP_ALLOCATION_TRAP, 1);
        setenv(kAllocationDirectory, counts_.c_str(), 1);
        bring_up_and_home();
        unsetenv("LD_PRELOAD");
        unsetenv(kAllocationDirectory);
    }
    void hold_and_resume() {
        std::this_thread::sleep_for(std::chrono::seconds(2));
        ASSERT_EQ(run_lockstep({"hold"}).code, 0);
        ASSERT_TRUE(becomes("Holding"));
        ASSERT_EQ(run_lockstep({"resume"}).code, 0);
        ASSERT_TRUE(becomes("Running"));
        std::this_thread::sleep_for(std::chrono::seconds(1));
    }
    std::filesystem::path counts_;
};

TEST_F(LoopAllocations, ThereAreNoneWhileAJobRunsIsHeldAndResumed) {
    bring_up_watched();
    std::map<std::string, std::unique_ptr<WatchedProcess>> processes;
    for (const char* name : {"coordinator", "axis-X", "axis-Y"}) {
        processes[name] = std::make_unique<WatchedProcess>(counts_, process(name));
        ASSERT_TRUE(processes[name]->is_watched()) << name;
    }
    std::string program = "G21 G90\n";
    for (int line = 0; line < 80; ++line) {
        program +=
            std::string("G1 X") + (line % 2 == 0 ? "20" : "50") + " Y" + std::to_string(line % 3 * 10) + " F3000\n";
    }
    ChildProcess run(LOCKSTEP_COMMAND, {"run", write("job.gcode", program), "--machine", file()});
    ASSERT_TRUE(becomes("Running"));
    hold_and_resume();
    std::this_thread::sleep_for(kWarmUp);
    std::map<std::string, std::map<std::uint64_t, std::uint64_t>> before;
    for (const auto& [name, watched] : processes) { before[name] = watched->places(); }
    const std::uint64_t by_libraries = processes["axis-X"]->other();
    hold_and_resume();
    EXPECT_EQ(status().phase(), "Running") << "the job has not ended before the count";
    for (const auto& [name, watched] : processes) {
        for (const auto& [place, calls] : watched->places()) {
            EXPECT_EQ(calls, before[name][place]) << name << " allocates: addr2line -Cfpe build/bin/lockstep-"
                                                  << name.substr(0, name.find('-')) << " 0x" << std::hex << place;
        }
    }
    EXPECT_GT(processes["axis-X"]->other(), by_libraries) << "calls are counted";
}

}  // namespace
}  // namespace lockstep
