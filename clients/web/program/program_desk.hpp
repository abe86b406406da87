// A thread for what takes long: reading programs and drawing their paths.
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

    /// False: too many wait already; nothing is done.
    bool add(std::function<void()> task);

    /// Null: no program is loaded.
    std::shared_ptr<const LoadedProgram> loaded() const;
    void load(LoadedProgram&& program);
    std::uint64_t next_id() { return ++last_id_; }  // in the thread only

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
