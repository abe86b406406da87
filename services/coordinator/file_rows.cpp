#include "services/coordinator/file_rows.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

#include "core/check.hpp"

namespace lockstep {
namespace {

constexpr std::uint64_t kLeastPages = 2 * FileRows::kCleanPages;

/// Returns false with the reason in errno.
bool write_all(int file, std::span<const std::byte> data, std::uint64_t offset) {
    while (!data.empty()) {
        const ssize_t written = pwrite(file, data.data(), data.size(), static_cast<off_t>(offset));
        if (written < 0 && errno == EINTR) { continue; }
        if (written <= 0) { return false; }
        data = data.subspan(static_cast<std::size_t>(written));
        offset += static_cast<std::uint64_t>(written);
    }
    return true;
}

/// Returns false with the reason in errno.
bool read_all(int file, std::span<std::byte> data, std::uint64_t offset) {
    while (!data.empty()) {
        const ssize_t read = pread(file, data.data(), data.size(), static_cast<off_t>(offset));
        if (read < 0 && errno == EINTR) { continue; }
        if (read == 0) { errno = EIO; }  // the file is too short
        if (read <= 0) { return false; }
        data = data.subspan(static_cast<std::size_t>(read));
        offset += static_cast<std::uint64_t>(read);
    }
    return true;
}

/// Removes the file's name at once, so that a killed coordinator leaves no file.
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
      directory_(std::move(directory)) {
    check(sem_init(&news_, 0, 0) == 0, "a semaphore of 0 can be made");
    constexpr std::size_t kMostPages = kCleanPages + kUnwrittenPages + 8;
    pages_.reserve(kMostPages);
    spare_.reserve(kMostPages);
    for (auto* works : {&to_do_, &returned_, &queue_, &done_}) { works->reserve(kMostPages); }
}

FileRows::~FileRows() {
    thread_.request_stop();
    sem_post(&news_);
    if (thread_.joinable()) { thread_.join(); }
    sem_destroy(&news_);
}

std::uint64_t FileRows::free_rows() {
    exchange_work();
    if (failure_ || unwritten_ >= kUnwrittenPages) { return failure_ ? kPageBytes : 0; }
    const std::uint64_t unwritten = (kUnwrittenPages - unwritten_) * page_rows_;
    const std::uint64_t most = (capacity_ + released_) * page_rows_;
    return std::min(unwritten, most - std::min(most, rows_));
}

/// Keeps the page of row `number` and the page before it.
void FileRows::release_before(std::uint32_t number) {
    const std::uint64_t page = number / page_rows_;
    released_ = std::max(released_, page > 0 ? page - 1 : 0);
}

std::uint32_t FileRows::first_row() const {
    const std::uint64_t pages = (rows_ + page_rows_ - 1) / page_rows_;
    return static_cast<std::uint32_t>((pages > capacity_ ? pages - capacity_ : 0) * page_rows_);
}

std::expected<void, std::string> FileRows::append(std::span<const double> rows) {
    exchange_work();
    if (failure_) { return std::unexpected(*failure_); }
    for (; !rows.empty(); rows = rows.subspan(width_)) { add_row(rows.first(width_)); }
    start_thread();
    exchange_work();
    return {};
}

void FileRows::add_row(std::span<const double> row) {
    const std::uint64_t number = rows_ / page_rows_;
    Resident* const filling = find(number);
    Resident& page = filling != nullptr ? *filling : add_page(number, PageState::Filling);
    std::ranges::copy(row, page.rows.begin() + static_cast<std::ptrdiff_t>(rows_ % page_rows_ * width_));
    page.used = ++clock_;
    if (++rows_ % page_rows_ != 0) { return; }
    page.state = PageState::Waiting;
    ++unwritten_;
    to_do_.push_back({number, true, page.rows});
}

bool FileRows::read(std::uint32_t number, std::span<double> row) {
    exchange_work();
    const std::uint64_t wanted = number / page_rows_;
    if ((wanted + 1) * page_rows_ < rows_) { request(wanted + 1); }
    Resident* const page = find(wanted);
    if (page == nullptr || page->state == PageState::Fetched) {
        request(wanted);
        return false;
    }
    page->used = ++clock_;
    const auto at = page->rows.begin() + static_cast<std::ptrdiff_t>(number % page_rows_ * width_);
    std::copy_n(at, width_, row.begin());
    return true;
}

FileRows::Resident* FileRows::find(std::uint64_t number) {
    if (recent_ < pages_.size() && pages_[recent_].number == number) { return &pages_[recent_]; }
    const auto found = std::ranges::find(pages_, number, &Resident::number);
    if (found == pages_.end()) { return nullptr; }
    recent_ = static_cast<std::size_t>(found - pages_.begin());
    return &*found;
}

FileRows::Resident& FileRows::add_page(std::uint64_t number, PageState state) {
    Page rows = spare_.empty() ? Page(page_rows_ * width_) : std::move(spare_.back());
    if (!spare_.empty()) { spare_.pop_back(); }
    return pages_.emplace_back(Resident{number, std::move(rows), state, ++clock_});
}

void FileRows::remove(Resident& page) {
    spare_.push_back(std::move(page.rows));
    if (&page != &pages_.back()) { page = std::move(pages_.back()); }
    pages_.pop_back();
}

void FileRows::request(std::uint64_t number) {
    if (find(number) != nullptr) { return; }
    Resident& page = add_page(number, PageState::Fetched);
    to_do_.push_back({number, false, page.rows});
}

void FileRows::evict() {
    while (pages_.size() > kCleanPages) {
        Resident* oldest = nullptr;
        for (Resident& page : pages_) {
            const bool is_older = oldest == nullptr || page.used < oldest->used;
            if (page.state == PageState::Clean && is_older) { oldest = &page; }
        }
        if (oldest == nullptr) { return; }
        remove(*oldest);
    }
}

void FileRows::start_thread() {
    if (thread_.joinable() || unwritten_ <= kUnwrittenPages / 2) { return; }
    thread_ = std::jthread([this](const std::stop_token& stop) { serve(stop); });
}

/// Exchanges nothing while the disk thread holds the lock.
void FileRows::exchange_work() {
    if (!thread_.joinable() || (to_do_.empty() && handed_over_ == 0)) { return; }
    const bool is_news = !to_do_.empty();
    {
        const std::unique_lock lock(mutex_, std::try_to_lock);
        if (!lock) { return; }
        queue_.insert(queue_.end(), to_do_.begin(), to_do_.end());
        std::swap(done_, returned_);
    }
    handed_over_ += to_do_.size();
    to_do_.clear();
    if (is_news) { sem_post(&news_); }
    for (const Work& work : returned_) { take_back(work); }
    returned_.clear();
}

/// A page that cannot be written stays in memory, so no row is lost. append() then refuses further rows.
void FileRows::take_back(const Work& work) {
    --handed_over_;
    Resident& page = check_found(find(work.page), "a page that is written or fetched is in memory");
    if (work.error == 0) {
        page.state = PageState::Clean;
        page.used = work.is_write ? page.used : ++clock_;
        unwritten_ -= work.is_write ? 1 : 0;
    } else if (!work.is_write) {
        remove(page);
    } else if (!failure_) {
        failure_ = fmt::format("the coordinator cannot keep the program in {}: {}; make room on its disk",
                               directory_.string(), std::strerror(work.error));
    }
    evict();
}

void FileRows::serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
        while (sem_wait(&news_) != 0) {}  // interrupted by a signal
        for (auto work = next_work(); work && !stop.stop_requested(); work = next_work()) {
            carry_out(*work);
            const std::lock_guard lock(mutex_);
            done_.push_back(*work);
        }
    }
}

/// Requested reads come before writes.
std::optional<FileRows::Work> FileRows::next_work() {
    const std::lock_guard lock(mutex_);
    if (queue_.empty()) { return std::nullopt; }
    const auto fetch = std::ranges::find(queue_, false, &Work::is_write);
    const auto next = fetch == queue_.end() ? queue_.begin() : fetch;
    const Work work = *next;
    queue_.erase(next);
    return work;
}

bool FileRows::open() {
    if (!file_.is_open()) { file_ = Descriptor(open_unnamed(directory_)); }
    return file_.is_open();
}

/// Writes nothing more after a failed write.
void FileRows::carry_out(Work& work) {
    const auto bytes = std::as_writable_bytes(work.rows);
    if (work.is_write && write_error_ == 0) {
        const bool is_written = open() && write_all(file_.get(), bytes, offset_of(work.page));
        write_error_ = is_written ? 0 : errno;
    }
    if (work.is_write) {
        work.error = write_error_;
        return;
    }
    const bool is_read = read_all(file_.get(), bytes, offset_of(work.page));
    work.error = is_read ? 0 : errno;
}

}  // namespace lockstep
