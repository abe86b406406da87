#include "services/coordinator/file_rows.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace lockstep {
namespace {

constexpr std::uint64_t kLeastPages = 2 * FileRows::kCleanPages;

/// False: errno says why.
bool write_all(int file, const char* data, std::size_t size, std::uint64_t offset) {
    while (size > 0) {
        const ssize_t written = pwrite(file, data, size, static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) { continue; }
        if (written <= 0) { return false; }
        data += written;
        size -= static_cast<std::size_t>(written);
        offset += static_cast<std::uint64_t>(written);
    }
    return true;
}

bool read_all(int file, char* data, std::size_t size, std::uint64_t offset) {
    while (size > 0) {
        const ssize_t read = pread(file, data, size, static_cast<off_t>(offset));
        if (read < 0 && errno == EINTR) { continue; }
        if (read <= 0) { return false; }
        data += read;
        size -= static_cast<std::size_t>(read);
        offset += static_cast<std::uint64_t>(read);
    }
    return true;
}

/// The name goes at once: a coordinator that is killed leaves nothing.
int open_unnamed(const std::filesystem::path& directory) {
    std::error_code ignored;
    std::filesystem::create_directories(directory, ignored);
    const int file = ::open(directory.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file >= 0 || (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL)) { return file; }
    std::string name = (directory / "program.XXXXXX").string();
    const int named = mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0) { unlink(name.c_str()); }
    return named;
}

}  // namespace

FileRows::FileRows(std::size_t width, std::filesystem::path directory, std::uint64_t limit_bytes)
    : width_(width),
      page_rows_(kPageBytes / (width * sizeof(double))),
      capacity_(std::max(kLeastPages, limit_bytes / kPageBytes)),
      directory_(std::move(directory)) {}

FileRows::~FileRows() {
    thread_.request_stop();
    news_.notify_all();
    if (thread_.joinable()) { thread_.join(); }
    if (file_ >= 0) { close(file_); }
}

std::uint64_t FileRows::free_rows() const {
    const std::lock_guard guard(mutex_);
    if (failure_ || unwritten_ >= kUnwrittenPages) { return failure_ ? kPageBytes : 0; }
    const std::uint64_t unwritten = (kUnwrittenPages - unwritten_) * page_rows_;
    const std::uint64_t most = (capacity_ + released_) * page_rows_;
    return std::min(unwritten, most - std::min(most, rows_));
}

/// The page of the first row that is still asked for is not released.
void FileRows::release_before(std::uint32_t number) {
    const std::lock_guard guard(mutex_);
    const std::uint64_t page = number / page_rows_;
    released_ = std::max(released_, page > 0 ? page - 1 : 0);
}

std::uint32_t FileRows::first_row() const {
    const std::lock_guard guard(mutex_);
    const std::uint64_t pages = (rows_ + page_rows_ - 1) / page_rows_;
    return static_cast<std::uint32_t>((pages > capacity_ ? pages - capacity_ : 0) * page_rows_);
}

std::expected<void, std::string> FileRows::append(std::span<const double> rows) {
    const std::lock_guard guard(mutex_);
    if (failure_) { return std::unexpected(*failure_); }
    for (; !rows.empty(); rows = rows.subspan(width_)) { add_row(rows.first(width_)); }
    evict();
    return {};
}

void FileRows::add_row(std::span<const double> row) {
    const std::uint64_t number = rows_ / page_rows_;
    Resident& page = pages_[number];
    page.rows.insert(page.rows.end(), row.begin(), row.end());
    page.used = ++clock_;
    if (++rows_ % page_rows_ != 0) { return; }
    page.state = PageState::Waiting;
    ++unwritten_;
    work_.push_back({number, true});
    news_.notify_one();
}

bool FileRows::read(std::uint32_t number, std::span<double> row) {
    const std::lock_guard guard(mutex_);
    const std::uint64_t wanted = number / page_rows_;
    if ((wanted + 1) * page_rows_ < rows_) { request(wanted + 1); }
    const auto page = pages_.find(wanted);
    if (page == pages_.end() || page->second.state == PageState::Fetched) {
        request(wanted);
        return false;
    }
    page->second.used = ++clock_;
    const auto at = page->second.rows.begin() + static_cast<std::ptrdiff_t>(number % page_rows_ * width_);
    std::copy_n(at, width_, row.begin());
    return true;
}

void FileRows::request(std::uint64_t page) {
    if (!pages_.try_emplace(page, Resident{{}, PageState::Fetched, ++clock_}).second) { return; }
    work_.push_front({page, false});
    news_.notify_one();
}

void FileRows::evict() {
    if (!thread_.joinable() && unwritten_ > kUnwrittenPages / 2) {
        thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
    }
    while (pages_.size() > kCleanPages) {
        auto oldest = pages_.end();
        for (auto page = pages_.begin(); page != pages_.end(); ++page) {
            const bool is_older = oldest == pages_.end() || page->second.used < oldest->second.used;
            if (page->second.state == PageState::Clean && is_older) { oldest = page; }
        }
        if (oldest == pages_.end()) { return; }
        pages_.erase(oldest);
    }
}

void FileRows::serve(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (news_.wait(lock, stop, [this] { return !work_.empty(); })) {
        const Work work = work_.front();
        work_.pop_front();
        work.is_write ? write(work.page, lock) : fetch(work.page, lock);
    }
}

bool FileRows::open() {
    if (file_ < 0) { file_ = open_unnamed(directory_); }
    return file_ >= 0;
}

/// What cannot be written stays in memory: it is not lost, and no more is taken.
void FileRows::write(std::uint64_t page, std::unique_lock<std::mutex>& lock) {
    if (failure_) { return; }
    const Page rows = pages_.at(page).rows;
    lock.unlock();
    const bool is_written = open() && write_all(file_, reinterpret_cast<const char*>(rows.data()),
                                                rows.size() * sizeof(double), offset_of(page));
    const int error = errno;
    lock.lock();
    if (!is_written) {
        failure_ = "the coordinator cannot keep the program in " + directory_.string() + ": " + std::strerror(error) +
                   "; make room there";
        return;
    }
    --unwritten_;
    pages_.at(page).state = PageState::Clean;
    evict();
}

void FileRows::fetch(std::uint64_t page, std::unique_lock<std::mutex>& lock) {
    Page rows(page_rows_ * width_);
    lock.unlock();
    const bool is_read =
        read_all(file_, reinterpret_cast<char*>(rows.data()), rows.size() * sizeof(double), offset_of(page));
    lock.lock();
    if (!is_read) {
        pages_.erase(page);
        return;
    }
    pages_[page] = {std::move(rows), PageState::Clean, ++clock_};
    evict();
}

}  // namespace lockstep
