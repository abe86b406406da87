// Passes all calls of a listener on to another in the same order, on a separate thread. The caller does not wait for
// the work. A StageThread between two stages makes both work in parallel.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "clients/analysis/measure/sorted_log.hpp"

namespace lockstep::analysis {

class StageThread final : public SortedListener {
public:
    /// The number of calls in a batch, and the maximum number of batches in the queue. They bound the memory.
    static constexpr std::size_t kTogether = 16;
    static constexpr std::size_t kMaxWaiting = 4;

    /// The other thread uses `listener` until finish().
    explicit StageThread(SortedListener& listener);
    StageThread(const StageThread&) = delete;
    StageThread& operator=(const StageThread&) = delete;
    ~StageThread() override { finish(); }

    void on_axis(const std::string& name) override;
    void on_measured(std::size_t lane, const SharedSteps& steps) override;
    void on_position(const axis_position_t& message) override;
    void on_run(std::size_t lane, const Run& run) override;
    void on_job(const RecordedJob& message, LogPlace place) override;
    void on_event(const program_event_t& message, const ProgramEvent& event) override;
    void on_damage(LogPlace place, const std::string& what) override;
    void on_late(const std::string& axis, const SharedLate& steps) override;

    /// Waits until all calls are passed on.
    void finish();

private:
    using Call = std::move_only_function<void(SortedListener&)>;
    using Batch = std::vector<Call>;

    void add(Call call);
    void hand_over();
    Batch next();  // empty after the last one
    void run(SortedListener& listener);

    Batch batch_;
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<Batch> waiting_;
    bool done_ = false;
    std::jthread thread_;
};

}  // namespace lockstep::analysis
