#include "services/runtime/background_sink.hpp"

#include <signal.h>

#include <atomic>
#include <string>
#include <utility>

#include <fmt/format.h>
#include <spdlog/formatter.h>

#include "services/runtime/line_queue.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kLines = 256;

/// Blocks all signals in this thread, so that a thread started meanwhile receives none.
class SignalsBlocked {
public:
    SignalsBlocked() {
        sigset_t all;
        sigfillset(&all);
        pthread_sigmask(SIG_SETMASK, &all, &before_);
    }
    ~SignalsBlocked() { pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
    SignalsBlocked(const SignalsBlocked&) = delete;
    SignalsBlocked& operator=(const SignalsBlocked&) = delete;

private:
    sigset_t before_{};
};

/// Returns whether the condition became true within this time.
template <typename Condition>
bool wait_until(std::chrono::milliseconds most, Condition condition) {
    constexpr std::chrono::milliseconds kStep{1};
    for (auto waited = kStep; waited <= most && !condition(); waited += kStep) { std::this_thread::sleep_for(kStep); }
    return condition();
}

}  // namespace

struct BackgroundSink::Shared {
    explicit Shared(spdlog::sink_ptr sink) : to(std::move(sink)) {}

    /// Catches the exception that spdlog throws if the disk is full.
    void write(std::chrono::system_clock::time_point time, int level, std::string_view text) {
        try {
            to->log({time, {}, {}, static_cast<spdlog::level::level_enum>(level), {text.data(), text.size()}});
            to->flush();
        } catch (const std::exception&) { unwritten.fetch_add(1, std::memory_order_relaxed); }
    }
    std::uint64_t lost() const { return queue.dropped() + unwritten.load(std::memory_order_relaxed); }
    void report_loss() {
        const std::uint64_t now = lost();
        if (now == reported) { return; }
        write(spdlog::log_clock::now(), spdlog::level::warn,
              fmt::format("- {} lines of this log are lost: they could not be written in time", now - reported));
        reported = lost();
    }

    spdlog::sink_ptr to;
    LineQueue<kLines> queue;
    std::atomic<std::uint32_t> changes = 0;  // counts added lines and the request to end
    std::atomic<bool> ends = false;
    std::atomic<bool> has_ended = false;  // the thread has ended
    std::atomic<std::uint64_t> unwritten = 0;
    std::uint64_t reported = 0;  // lost lines reported so far
};

BackgroundSink::BackgroundSink(spdlog::sink_ptr to) : shared_(std::make_shared<Shared>(std::move(to))) {
    const SignalsBlocked blocked;
    thread_ = std::thread([shared = shared_] { serve(shared); });
}

BackgroundSink::~BackgroundSink() {
    shared_->ends = true;
    shared_->changes.fetch_add(1);
    shared_->changes.notify_one();
    wait_until(kPatience, [&] { return shared_->has_ended.load(); }) ? thread_.join() : thread_.detach();
}

void BackgroundSink::log(const spdlog::details::log_msg& message) {
    (void)shared_->queue.add(message.time, message.level, {message.payload.data(), message.payload.size()});
    shared_->changes.fetch_add(1);
    shared_->changes.notify_one();
}

void BackgroundSink::set_pattern(const std::string& pattern) { shared_->to->set_pattern(pattern); }

void BackgroundSink::set_formatter(std::unique_ptr<spdlog::formatter> formatter) {
    shared_->to->set_formatter(std::move(formatter));
}

void BackgroundSink::drain(std::chrono::milliseconds most) const {
    (void)wait_until(most, [&] { return shared_->queue.is_empty(); });
}

std::uint64_t BackgroundSink::lost() const { return shared_->lost(); }

void BackgroundSink::serve(const std::shared_ptr<Shared>& shared) {
    const auto write = [&](const LogLine& line) { shared->write(line.time, line.level, line.view()); };
    while (!shared->has_ended) {
        const std::uint32_t changes = shared->changes.load();
        while (shared->queue.take(write)) {}
        shared->report_loss();
        const bool is_last = shared->ends && shared->queue.is_empty();
        is_last ? shared->has_ended.store(true) : shared->changes.wait(changes);
    }
}

}  // namespace lockstep
