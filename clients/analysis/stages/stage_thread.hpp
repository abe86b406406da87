// Passes all calls of a listener on to another in the same order, on a separate thread. The caller does not wait for
// the work. A StageThread between two stages makes both work in parallel.
#pragma once

#include <cstddef>
#include <string>

#include "clients/analysis/measure/sorted_log.hpp"
#include "clients/analysis/stages/work_thread.hpp"

namespace lockstep::analysis {

class StageThread final : public SortedListener {
public:
    /// The other thread uses `listener` until finish().
    explicit StageThread(SortedListener& listener) : listener_(listener) {}
    StageThread(const StageThread&) = delete;
    StageThread& operator=(const StageThread&) = delete;

    void on_axis(const std::string& name) override;
    void on_measured(std::size_t lane, const SharedSteps& steps) override;
    void on_position(const axis_position_t& message) override;
    void on_run(std::size_t lane, const Run& run) override;
    void on_job(const RecordedJob& message, LogPlace place) override;
    void on_event(const program_event_t& message, const ProgramEvent& event) override;
    void on_channel(const channel_event_t& message) override;
    void on_damage(LogPlace place, const std::string& what) override;
    void on_late(const std::string& axis, const SharedLate& steps) override;

    /// Waits until all calls are passed on.
    void finish() { work_.finish(); }

private:
    SortedListener& listener_;
    WorkThread work_;
};

}  // namespace lockstep::analysis
