#include "clients/analysis/stages/work_thread.hpp"

#include <utility>

namespace lockstep::analysis {

WorkThread::WorkThread() : thread_([this] { run(); }) {}

void WorkThread::add(Call call) {
    batch_.push_back(std::move(call));
    if (batch_.size() == kTogether) { hand_over(); }
}

void WorkThread::hand_over() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting; });
    waiting_.push_back(std::exchange(batch_, {}));
    changed_.notify_all();
}

void WorkThread::finish() {
    if (!thread_.joinable()) { return; }
    if (!batch_.empty()) { hand_over(); }
    {
        const std::scoped_lock lock(mutex_);
        done_ = true;
        changed_.notify_all();
    }
    thread_.join();
}

WorkThread::Batch WorkThread::next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_ || !waiting_.empty(); });
    if (waiting_.empty()) { return {}; }
    Batch batch = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    return batch;
}

void WorkThread::run() {
    for (Batch batch = next(); !batch.empty(); batch = next()) {
        for (Call& call : batch) { call(); }
    }
}

}  // namespace lockstep::analysis
