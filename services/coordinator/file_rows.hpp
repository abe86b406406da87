// The blocks of a program on the coordinator's disk: a file without a name, written and read by a thread of its own, so
// that no loop waits for the disk. Short programs stay in memory.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "core/coordinator/program/row_store.hpp"

namespace lockstep {

/// When `limit_bytes` are full, released rows make room for new ones.
class FileRows final : public RowStore {
public:
    FileRows(std::size_t width, std::filesystem::path directory, std::uint64_t limit_bytes);
    ~FileRows() override;
    FileRows(const FileRows&) = delete;
    FileRows& operator=(const FileRows&) = delete;

    std::expected<void, std::string> append(std::span<const double> rows) override;
    bool read(std::uint32_t number, std::span<double> row) override;
    std::uint64_t free_rows() const override;
    void release_before(std::uint32_t number) override;
    std::uint32_t first_row() const override;

    static constexpr std::size_t kPageBytes = 65'536;
    static constexpr std::size_t kCleanPages = 32;      // that stay in memory beside the file
    static constexpr std::size_t kUnwrittenPages = 32;  // then no more rows are taken until the disk has some of them

private:
    using Page = std::vector<double>;
    enum class PageState : std::uint8_t { Filling, Waiting, Clean, Fetched };
    struct Resident {
        Page rows;
        PageState state = PageState::Filling;
        std::uint64_t used = 0;
    };
    struct Work {
        std::uint64_t page = 0;
        bool is_write = false;
    };

    void add_row(std::span<const double> row);
    void request(std::uint64_t page);
    void evict();
    void serve(const std::stop_token& stop);
    void write(std::uint64_t page, std::unique_lock<std::mutex>& lock);
    void fetch(std::uint64_t page, std::unique_lock<std::mutex>& lock);
    bool open();
    std::uint64_t offset_of(std::uint64_t page) const { return page % capacity_ * kPageBytes; }

    std::size_t width_;
    std::size_t page_rows_;
    std::uint64_t capacity_;  // in pages
    std::filesystem::path directory_;
    mutable std::mutex mutex_;
    std::condition_variable_any news_;
    std::map<std::uint64_t, Resident> pages_;  // in memory
    std::deque<Work> work_;
    std::uint64_t rows_ = 0;      // appended
    std::uint64_t released_ = 0;  // pages
    std::uint64_t unwritten_ = 0;
    std::uint64_t clock_ = 0;  // counts uses of pages
    std::optional<std::string> failure_;
    int file_ = -1;
    std::jthread thread_;  // begins when half of the unwritten pages are there
};

}  // namespace lockstep
