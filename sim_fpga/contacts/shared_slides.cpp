#include "sim_fpga/contacts/shared_slides.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cstring>
#include <utility>

namespace lockstep {
namespace {

constexpr std::size_t kBytes = 4096;
constexpr double kCountsOn_s = 0.1;
constexpr int kMaxTries = 100;  // others may remove it as often while this process opens it

std::unexpected<std::string> cannot(const std::string& name, const char* action) {
    return std::unexpected("shared memory \"" + name + "\" of the simulated slides: cannot " + action + ": " +
                           std::strerror(errno));
}

/// A file of shared memory that its users hold by a shared lock, which ends with the process in any case.
class HeldMemory {
public:
    HeldMemory(std::string name, int file) : name_(std::move(name)), file_(file) {}
    HeldMemory(const HeldMemory&) = delete;
    HeldMemory& operator=(const HeldMemory&) = delete;
    ~HeldMemory() {
        if (words_ != nullptr) { ::munmap(words_, kBytes); }
        const bool is_last = ::flock(file_, LOCK_EX | LOCK_NB) == 0;
        if (is_last && is_linked()) { ::shm_unlink(name_.c_str()); }
        ::close(file_);
    }

    /// Returns false if it was removed before the lock was taken.
    bool hold() const { return ::flock(file_, LOCK_SH) == 0 && is_linked(); }
    bool map() {
        if (::ftruncate(file_, kBytes) != 0) { return false; }
        void* const memory = ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file_, 0);
        if (memory == MAP_FAILED) { return false; }
        words_ = static_cast<std::int64_t*>(memory);
        return true;
    }
    std::int64_t* words() const { return words_; }

private:
    bool is_linked() const {
        struct stat status {};
        return ::fstat(file_, &status) == 0 && status.st_nlink > 0;
    }

    std::string name_;
    int file_;
    std::int64_t* words_ = nullptr;
};

}  // namespace

std::string SharedSlides::name_of(const std::string& machine, std::uint32_t domain) {
    return "/lockstep-slides-" + machine + "-" + std::to_string(domain);
}

std::expected<SharedSlides, std::string> SharedSlides::open(const MachineConfig& machine, std::uint32_t domain) {
    const std::string name = name_of(machine.name, domain);
    for (int tries = 0; tries < kMaxTries; ++tries) {
        const int file = ::shm_open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0660);
        if (file < 0) { return cannot(name, "open it"); }
        const auto memory = std::make_shared<HeldMemory>(name, file);
        if (!memory->hold()) { continue; }
        if (!memory->map()) { return cannot(name, "map it"); }
        return SharedSlides({memory, memory->words()}, machine);
    }
    return cannot(name, "lock it");
}

SharedSlides::SharedSlides(std::shared_ptr<std::int64_t[]> words, const MachineConfig& machine)
    : words_(std::move(words)),
      motors_(motors_of(machine)),
      counts_on_{static_cast<std::int64_t>(kCountsOn_s * machine.ticks_per_second())} {
    static_assert(kMaxAxes * Words * sizeof(std::int64_t) <= kBytes);
}

void SharedSlides::publish(MotorIndex motor, const SlideMotion& slide) {
    const std::int64_t turn = word(motor, Turn).load();
    word(motor, Turn).store(turn | 1);
    word(motor, Steps).store(slide.steps);
    word(motor, At).store(slide.at.value);
    word(motor, Speed).store(std::bit_cast<std::int64_t>(slide.steps_per_tick));
    word(motor, Turn).store((turn | 1) + 1);
}

/// A process that ended while it published leaves an odd turn. Then what it wrote last is taken.
SlideMotion SharedSlides::slide(MotorIndex motor) const {
    SlideMotion slide;
    for (int tries = 0; tries < kMaxTries; ++tries) {
        const std::int64_t turn = word(motor, Turn).load();
        slide = {word(motor, Steps).load(), Tick{word(motor, At).load()},
                 std::bit_cast<double>(word(motor, Speed).load())};
        if (turn % 2 == 0 && word(motor, Turn).load() == turn) { break; }
    }
    return slide;
}

std::vector<Position> SharedSlides::places(Tick now) const {
    std::vector<Position> places;
    for (const MotorIndex m : motor_indices(motors_.size())) {
        const double steps = slide(m).place(now, counts_on_);
        const double way_mm = motors_[m].steps_per_mm > 0 ? steps / motors_[m].steps_per_mm : 0;
        places.push_back(Position::steps(to_steps(motors_[m], motors_[m].plant.start_position_mm + way_mm)));
    }
    return places;
}

}  // namespace lockstep
