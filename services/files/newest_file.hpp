// Keeps the newest of several values in a file that outlives the process. A thread writes the file. keep() waits
// neither for the disk nor for the thread. If values come faster than the disk takes them, only the newest is written.
#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "services/files/newest_value.hpp"

namespace lockstep {

/// Replaces the text of a file. Only the writing thread calls write().
class NumberedText {
public:
    /// Called when a write fails, but not again until a write has succeeded.
    using OnFailure = void (*)(const std::string& why);
    NumberedText(std::filesystem::path path, OnFailure on_failure) : path_(std::move(path)), on_failure_(on_failure) {}

    void write(std::uint64_t number, const std::string& text);
    /// The number of the text on the disk; 0 if none was written.
    std::uint64_t kept() const { return kept_; }

private:
    std::filesystem::path path_;
    OnFailure on_failure_;
    bool failed_ = false;  // the last write failed
    std::atomic<std::uint64_t> kept_{0};
};

template <typename T>
class NewestFile {
public:
    using OnFailure = NumberedText::OnFailure;
    using TextOf = std::string (*)(const T& value);
    /// The writing thread calls `text_of` and `on_failure`.
    NewestFile(std::filesystem::path path, TextOf text_of, OnFailure on_failure)
        : text_of_(text_of),
          file_(std::move(path), on_failure),
          thread_([this](const std::stop_token& stop) { serve(stop); }) {}
    NewestFile(const NewestFile&) = delete;
    NewestFile& operator=(const NewestFile&) = delete;
    /// Waits until everything is written.
    ~NewestFile() {
        thread_.request_stop();
        wake();
        thread_.join();
    }

    void keep(std::uint64_t number, T value) {
        newest_.put({number, std::move(value)});
        wake();
    }
    /// The number of the value on the disk; 0 if none was written.
    std::uint64_t kept() const { return file_.kept(); }

private:
    struct Numbered {
        std::uint64_t number = 0;
        T value{};
    };

    void wake() {
        news_.fetch_add(1, std::memory_order_release);
        news_.notify_one();
    }
    void serve(const std::stop_token& stop) {
        for (bool ends = false; !ends;) {
            const std::uint32_t news = news_.load(std::memory_order_acquire);
            ends = stop.stop_requested();
            while (const Numbered* next = newest_.take()) { file_.write(next->number, text_of_(next->value)); }
            if (!ends) { news_.wait(news); }
        }
    }

    TextOf text_of_;
    NumberedText file_;
    NewestValue<Numbered> newest_;
    std::atomic<std::uint32_t> news_{0};
    std::jthread thread_;  // declared last, so that it ends first
};

}  // namespace lockstep
