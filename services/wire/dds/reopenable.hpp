// A network link of a process that can be reopened while the loop runs. Closing waits for DDS's threads, and opening
// waits for the kernel and for name lookups, so a separate thread does both.
#pragma once

#include <atomic>
#include <chrono>
#include <expected>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

#include "services/runtime/sleep.hpp"

namespace lockstep {

template <typename Link>
class Reopenable {
public:
    using Open = std::function<std::expected<std::unique_ptr<Link>, std::string>()>;
    using OnFailure = std::function<void(const std::string& why)>;

    /// The thread calls `open` until it succeeds or this object is destroyed, with a pause after each failure. It calls
    /// `on_failure` at each failure.
    Reopenable(std::unique_ptr<Link> first, Open open, OnFailure on_failure)
        : link_(std::move(first)), open_(std::move(open)), on_failure_(std::move(on_failure)) {}

    /// Null while the link is being reopened.
    Link* get() {
        if (!link_ && is_open_.exchange(false)) {
            thread_.join();
            link_ = std::move(next_);
        }
        return link_.get();
    }

    /// Closes the link and opens another. Returns at once and invalidates the pointer from get(). Has no effect while
    /// the link is not open.
    void reopen() {
        if (!link_) { return; }
        thread_ = std::jthread([this, old = std::move(link_)](const std::stop_token& stop) mutable {
            old.reset();  // before opening: a process can have a DDS domain only once
            run(stop);
        });
    }

private:
    static constexpr std::chrono::milliseconds kBetweenTries{500};

    void run(const std::stop_token& stop) {
        while (!stop.stop_requested()) {
            auto opened = open_();
            if (opened) {
                next_ = std::move(*opened);
                is_open_ = true;
                return;
            }
            on_failure_(opened.error());
            (void)sleep_unless(stop, kBetweenTries);
        }
    }

    std::unique_ptr<Link> link_;
    Open open_;
    OnFailure on_failure_;
    std::unique_ptr<Link> next_;  // used only by the thread until is_open_
    std::atomic<bool> is_open_ = false;
    std::jthread thread_;  // declared last, so that it ends first
};

}  // namespace lockstep
