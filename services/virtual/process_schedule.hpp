// Keeps for each process of a virtual machine when its loop runs next.
#pragma once

#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "core/units.hpp"

namespace lockstep {

class ProcessSchedule {
public:
    ProcessSchedule(std::size_t processes, Ticks period) : processes_(processes), period_(period) {}

    /// start() makes the process run at once. start_all() gives each process a random phase within the period.
    void start(std::size_t process, Tick now) { processes_[process] = {true, now}; }
    void start_all(Tick now, std::uint64_t seed) {
        std::mt19937_64 random(seed ^ 0x9e3779b97f4a7c15U);
        for (Process& process : processes_) {
            const auto phase = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(period_.value));
            process = {true, now + Ticks{phase}};
        }
    }
    void end(std::size_t process) { processes_[process] = {}; }
    void run(std::size_t process) { processes_[process].next += period_; }
    /// Its loop does not run before `until`.
    void delay(std::size_t process, Tick until) {
        processes_[process].next = std::max(processes_[process].next, until);
    }

    /// Returns the running process with the earliest next loop; nullopt if no process runs.
    std::optional<std::size_t> next() const {
        std::optional<std::size_t> next;
        for (std::size_t i = 0; i < processes_.size(); ++i) {
            if (processes_[i].is_alive && (!next || at(i) < at(*next))) { next = i; }
        }
        return next;
    }
    Tick at(std::size_t process) const { return processes_[process].next; }
    /// Whether the process is alive and its loop is not frozen.
    bool is_up(std::size_t process, Tick now) const {
        return processes_[process].is_alive && at(process) <= now + period_;
    }

private:
    struct Process {
        bool is_alive = false;
        Tick next;
    };
    std::vector<Process> processes_;
    Ticks period_;
};

}  // namespace lockstep
