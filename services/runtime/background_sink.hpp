// Writes the log in its own thread, so that no loop waits for a disk that hangs. A line that does not fit into the
// queue is lost, counted, and reported in the log as soon as the disk works again.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>

#include <spdlog/sinks/sink.h>

namespace lockstep {

class BackgroundSink final : public spdlog::sinks::sink {
public:
    /// to: where the lines are written.
    explicit BackgroundSink(spdlog::sink_ptr to);
    /// Writes the queued lines, but waits at most kPatience.
    ~BackgroundSink() override;
    BackgroundSink(const BackgroundSink&) = delete;
    BackgroundSink& operator=(const BackgroundSink&) = delete;

    /// Never waits.
    void log(const spdlog::details::log_msg& message) override;
    void flush() override {}  // each line is flushed as it is written
    void set_pattern(const std::string& pattern) override;
    void set_formatter(std::unique_ptr<spdlog::formatter> formatter) override;

    /// Waits until all lines are written, but at most for this time.
    void drain(std::chrono::milliseconds most) const;
    /// Lines that were not written.
    std::uint64_t lost() const;

    static constexpr std::chrono::milliseconds kPatience{1000};

private:
    struct Shared;
    static void serve(const std::shared_ptr<Shared>& shared);

    std::shared_ptr<Shared> shared_;  // the thread's too: if the disk hangs, the thread outlives this object
    std::thread thread_;
};

}  // namespace lockstep
