// Stores the blocks of a program in an unnamed file on the coordinator's disk. A separate thread reads and writes the
// file, so no loop waits for the disk. Short programs stay in memory.
#pragma once

#include <semaphore.h>

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "core/coordinator/program/row_store.hpp"
#include "services/files/descriptor.hpp"

namespace lockstep {

/// When `limit_bytes` are used, new rows overwrite released ones. One thread calls the public functions and never
/// waits: they exchange pages with the disk thread if its lock is free, otherwise in a later call.
class FileRows final : public RowStore {
public:
    FileRows(std::size_t width, std::filesystem::path directory, std::uint64_t limit_bytes);
    ~FileRows() override;
    FileRows(const FileRows&) = delete;
    FileRows& operator=(const FileRows&) = delete;

    std::expected<void, std::string> append(std::span<const double> rows) override;
    bool read(std::uint32_t number, std::span<double> row) override;
    std::uint64_t free_rows() override;
    void release_before(std::uint32_t number) override;
    std::uint32_t first_row() const override;

    static constexpr std::size_t kPageBytes = 65'536;
    static constexpr std::size_t kCleanPages = 32;      // pages of the file that also stay in memory
    static constexpr std::size_t kUnwrittenPages = 32;  // at this number, free_rows() is 0 until some are written

private:
    using Page = std::vector<double>;
    enum class PageState : std::uint8_t { Filling, Waiting, Clean, Fetched };
    struct Resident {
        std::uint64_t number = 0;
        Page rows;
        PageState state = PageState::Filling;
        std::uint64_t used = 0;
    };
    /// An order to the disk thread. The rows do not move in memory until the order is returned.
    struct Work {
        std::uint64_t page = 0;
        bool is_write = false;
        std::span<double> rows;
        int error = 0;  // errno, if it failed
    };

    Resident* find(std::uint64_t number);
    Resident& add_page(std::uint64_t number, PageState state);
    void remove(Resident& page);
    void add_row(std::span<const double> row);
    void request(std::uint64_t number);
    void evict();
    void exchange_work();
    void take_back(const Work& work);
    void start_thread();

    void serve(const std::stop_token& stop);
    std::optional<Work> next_work();
    void carry_out(Work& work);
    bool open();
    std::uint64_t offset_of(std::uint64_t page) const { return page % capacity_ * kPageBytes; }

    std::size_t width_;
    std::size_t page_rows_;
    std::uint64_t capacity_;  // in pages
    std::filesystem::path directory_;
    std::vector<Resident> pages_;  // in memory
    std::size_t recent_ = 0;       // index of the page found last
    std::vector<Page> spare_;      // memory for reuse
    std::vector<Work> to_do_;      // not handed over yet
    std::vector<Work> returned_;
    std::size_t handed_over_ = 0;  // orders not returned yet
    std::uint64_t rows_ = 0;       // appended
    std::uint64_t released_ = 0;   // pages
    std::uint64_t unwritten_ = 0;
    std::uint64_t clock_ = 0;  // counts uses of pages
    std::optional<std::string> failure_;

    std::mutex mutex_;  // guards queue_ and done_; held only while elements are copied
    std::vector<Work> queue_;
    std::vector<Work> done_;
    sem_t news_;  // std::counting_semaphore of GCC 12's library can lose a wake-up (GCC bug 104928)

    // Of the disk thread:
    Descriptor file_;
    int write_error_ = 0;
    std::jthread thread_;  // starts when more than kUnwrittenPages / 2 pages are unwritten
};

}  // namespace lockstep
