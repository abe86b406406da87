// Writes the log in a separate thread, so that no loop waits for a disk that hangs. A line that does not fit into the
// queue is lost. The sink counts such lines and reports them in the log when the disk works again.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <thread>

#include <spdlog/sinks/sink.h>

namespace lockstep {

class BackgroundSink final : public spdlog::sinks::sink {
public:
    /// `to` is the sink that writes the lines.
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

    std::shared_ptr<Shared> shared_;  // shared with the thread, which outlives this object if the disk hangs
    std::thread thread_;
};

}  // namespace lockstep
