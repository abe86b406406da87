#include "clients/web/program/program_desk.hpp"

namespace lockstep::web {

ProgramDesk::ProgramDesk() : thread_([this](const std::stop_token& stop) { work(stop); }) {}

ProgramDesk::~ProgramDesk() {
    thread_.request_stop();
    thread_.join();
}

bool ProgramDesk::add(std::function<void()> task) {
    const std::lock_guard lock(mutex_);
    if (tasks_.size() >= kMostTasks) { return false; }
    tasks_.push_back(std::move(task));
    added_.notify_one();
    return true;
}

std::shared_ptr<const LoadedProgram> ProgramDesk::loaded() const {
    const std::lock_guard lock(mutex_);
    return loaded_;
}

void ProgramDesk::load(LoadedProgram&& program) {
    const std::lock_guard lock(mutex_);
    loaded_ = std::make_shared<const LoadedProgram>(std::move(program));
}

void ProgramDesk::work(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        std::function<void()> task;
        {
            std::unique_lock lock(mutex_);
            if (!added_.wait(lock, stop, [this] { return !tasks_.empty(); })) { return; }
            task = std::move(tasks_.front());
            tasks_.pop_front();
        }
        task();
    }
}

}  // namespace lockstep::web
