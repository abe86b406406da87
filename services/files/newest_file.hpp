// Keeps the newest of several texts in a file that outlives the process. A thread writes the file, so keep() never
// waits for the disk. If texts come faster than the disk takes them, only the newest is written.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace lockstep {

class NewestFile {
public:
    using OnFailure = void (*)(const std::string& why);
    using Text = std::function<std::string()>;
    /// The writing thread calls `on_failure` when a write fails, but not again until a write has succeeded.
    NewestFile(std::filesystem::path path, OnFailure on_failure);
    /// Waits until everything is written.
    ~NewestFile();

    /// The writing thread calls `text`.
    void keep(std::uint64_t number, Text text);
    /// The number of the text on the disk; 0 if none was written.
    std::uint64_t kept() const { return kept_; }

private:
    struct Next {
        std::uint64_t number = 0;
        Text text;
    };
    void serve(const std::stop_token& stop);
    void write(const Next& next);

    std::filesystem::path path_;
    OnFailure on_failure_;
    bool failed_ = false;  // the last write failed
    std::atomic<std::uint64_t> kept_{0};
    std::mutex mutex_;
    std::condition_variable_any news_;
    std::optional<Next> next_;
    std::jthread thread_;
};

}  // namespace lockstep
