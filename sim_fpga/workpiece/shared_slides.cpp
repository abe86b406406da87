#include "sim_fpga/workpiece/shared_slides.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace lockstep {
namespace {

constexpr std::size_t kBytes = 4096;
static_assert(kMaxAxes * sizeof(std::int64_t) <= kBytes);

std::unexpected<std::string> cannot(const std::string& name, const char* action) {
    return std::unexpected("shared memory \"" + name + "\" of the simulated workpiece: cannot " + action + ": " +
                           std::strerror(errno));
}

}  // namespace

std::expected<SharedSlides, std::string> SharedSlides::open(const MachineConfig& machine) {
    const std::string name = "/lockstep-slides-" + machine.name + "-" + std::to_string(machine.network.domain);
    const int file = ::shm_open(name.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0660);
    if (file < 0) { return cannot(name, "open it"); }
    void* memory = MAP_FAILED;
    if (::ftruncate(file, kBytes) == 0) {
        memory = ::mmap(nullptr, kBytes, PROT_READ | PROT_WRITE, MAP_SHARED, file, 0);
    }
    const int error = errno;
    ::close(file);
    errno = error;
    if (memory == MAP_FAILED) { return cannot(name, "map it"); }
    return SharedSlides(std::shared_ptr<std::int64_t[]>(static_cast<std::int64_t*>(memory),
                                                        [](std::int64_t* words) { ::munmap(words, kBytes); }),
                        motors_of(machine));
}

std::vector<Position> SharedSlides::places() const {
    std::vector<Position> places;
    for (const MotorIndex m : motor_indices(motors_.size())) {
        const auto steps = static_cast<double>(word(m).load(std::memory_order_relaxed));
        const double way_mm = motors_[m].steps_per_mm > 0 ? steps / motors_[m].steps_per_mm : 0;
        places.push_back(Position::steps(to_steps(motors_[m], motors_[m].plant.start_position_mm + way_mm)));
    }
    return places;
}

}  // namespace lockstep
