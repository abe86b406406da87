// Does work on a separate thread, in the order in which it was added. The caller does not wait for it.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace lockstep::analysis {

class WorkThread {
public:
    /// The number of calls in a batch, and the maximum number of batches in the queue. They bound the memory.
    static constexpr std::size_t kTogether = 64;
    static constexpr std::size_t kMaxWaiting = 4;

    using Call = std::move_only_function<void()>;

    WorkThread();
    WorkThread(const WorkThread&) = delete;
    WorkThread& operator=(const WorkThread&) = delete;
    ~WorkThread() { finish(); }

    /// Waits while the queue is full.
    void add(Call call);
    /// Waits until all work is done. Nothing may be added later.
    void finish();

private:
    using Batch = std::vector<Call>;

    void hand_over();
    Batch next();  // empty after the last one
    void run();

    Batch batch_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Batch> waiting_;
    bool done_ = false;
    std::jthread thread_;
};

}  // namespace lockstep::analysis
