// A thread for tasks that take long, such as reading programs and reducing their paths.
#pragma once

#include <condition_variable>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

#include "clients/web/program/program_reading.hpp"

namespace lockstep::web {

class ProgramDesk {
public:
    static constexpr std::size_t kMostTasks = 8;  // that wait

    ProgramDesk();
    ~ProgramDesk();

    /// Returns false, and does nothing, if too many tasks wait already.
    bool add(std::function<void()> task);

    /// Returns null if no program is loaded.
    std::shared_ptr<const LoadedProgram> loaded() const;
    void load(LoadedProgram&& program);
    std::uint64_t next_id() { return ++last_id_; }  // call it only in the thread

private:
    void work(const std::stop_token& stop);

    mutable std::mutex mutex_;
    std::condition_variable_any added_;
    std::deque<std::function<void()>> tasks_;
    std::shared_ptr<const LoadedProgram> loaded_;
    std::uint64_t last_id_ = 0;
    std::jthread thread_;  // the last member: it uses the others
};

}  // namespace lockstep::web
