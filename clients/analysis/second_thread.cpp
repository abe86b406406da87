#include "clients/analysis/second_thread.hpp"

#include <utility>

namespace lockstep::analysis {

SecondThread::SecondThread(SortedListener& listener) : thread_([this, &listener] { run(listener); }) {}

void SecondThread::on_axis(const std::string& name) {
    add([name](SortedListener& to) { to.on_axis(name); });
}

void SecondThread::on_measured(std::size_t lane, std::span<const MeasuredStep> steps, Ticks clock_error) {
    add([lane, kept = std::vector(steps.begin(), steps.end()), clock_error](SortedListener& to) {
        to.on_measured(lane, kept, clock_error);
    });
}

void SecondThread::on_position(const axis_position_t& message) {
    add([message](SortedListener& to) { to.on_position(message); });
}

void SecondThread::on_run(std::size_t lane, const Run& run) {
    add([lane, run](SortedListener& to) { to.on_run(lane, run); });
}

void SecondThread::on_job(const job_t& message, LogPlace place) {
    add([message, place](SortedListener& to) { to.on_job(message, place); });
}

void SecondThread::on_damage(LogPlace place, const std::string& what) {
    add([place, what](SortedListener& to) { to.on_damage(place, what); });
}

void SecondThread::add(Tell tell) {
    batch_.push_back(std::move(tell));
    if (batch_.size() == kTogether) { hand_over(); }
}

void SecondThread::hand_over() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return waiting_.size() < kMaxWaiting; });
    waiting_.push_back(std::exchange(batch_, {}));
    changed_.notify_all();
}

void SecondThread::finish() {
    if (!thread_.joinable()) { return; }
    if (!batch_.empty()) { hand_over(); }
    {
        const std::scoped_lock lock(mutex_);
        done_ = true;
        changed_.notify_all();
    }
    thread_.join();
}

SecondThread::Batch SecondThread::next() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return done_ || !waiting_.empty(); });
    if (waiting_.empty()) { return {}; }
    Batch batch = std::move(waiting_.front());
    waiting_.pop_front();
    changed_.notify_all();
    return batch;
}

void SecondThread::run(SortedListener& listener) {
    for (Batch batch = next(); !batch.empty(); batch = next()) {
        for (Tell& tell : batch) { tell(listener); }
    }
}

}  // namespace lockstep::analysis
