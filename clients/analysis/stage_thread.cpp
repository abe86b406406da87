#include "clients/analysis/stage_thread.hpp"

#include <utility>

namespace lockstep::analysis {

StageThread::StageThread(SortedListener& listener) : thread_([this, &listener] { run(listener); }) {}

void StageThread::on_axis(const std::string& name) {
    add([name](SortedListener& to) { to.on_axis(name); });
}

void StageThread::on_measured(std::size_t lane, const SharedSteps& steps) {
    add([lane, steps](SortedListener& to) { to.on_measured(lane, steps); });
}

void StageThread::on_position(const axis_position_t& message) {
    add([message](SortedListener& to) { to.on_position(message); });
}

void StageThread::on_run(std::size_t lane, const Run& run) {
    add([lane, run](SortedListener& to) { to.on_run(lane, run); });
}

void StageThread::on_job(const RecordedJob& message, LogPlace place) {
    add([message, place](SortedListener& to) { to.on_job(message, place); });
}

void StageThread::on_event(const program_event_t& message, const ProgramEvent& event) {
    add([message, event](SortedListener& to) { to.on_event(message, event); });
}

void StageThread::on_damage(LogPlace place, const std::string& what) {
    add([place, what](SortedListener& to) { to.on_damage(place, what); });
}

void StageThread::on_late(const std::string& axis, const SharedLate& steps) {
    add([axis, steps](SortedListener& to) { to.on_late(axis, steps); });
}

void StageThread::add(Call call) {
    batch_.push_back(std::move(call));
    if (batch_.size() == kTogether) { hand_over(); }
}

void StageThread::hand_over() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting; });
    waiting_.push_back(std::exchange(batch_, {}));
    changed_.notify_all();
}

void StageThread::finish() {
    if (!thread_.joinable()) { return; }
    if (!batch_.empty()) { hand_over(); }
    {
        const std::scoped_lock lock(mutex_);
        done_ = true;
        changed_.notify_all();
    }
    thread_.join();
}

StageThread::Batch StageThread::next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_ || !waiting_.empty(); });
    if (waiting_.empty()) { return {}; }
    Batch batch = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    return batch;
}

void StageThread::run(SortedListener& listener) {
    for (Batch batch = next(); !batch.empty(); batch = next()) {
        for (Call& call : batch) { call(listener); }
    }
}

}  // namespace lockstep::analysis
