#include "services/files/newest_file.hpp"

#include <utility>

#include "services/files/text_file.hpp"

namespace lockstep {

NewestFile::NewestFile(std::filesystem::path path, OnFailure on_failure)
    : path_(std::move(path)), on_failure_(on_failure), thread_([this](const std::stop_token& stop) { serve(stop); }) {}

NewestFile::~NewestFile() {
    thread_.request_stop();
    thread_.join();
}

void NewestFile::keep(std::uint64_t number, Text text) {
    {
        const std::scoped_lock lock(mutex_);
        next_ = Next{number, std::move(text)};
    }
    news_.notify_one();
}

void NewestFile::serve(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (news_.wait(lock, stop, [this] { return next_.has_value(); })) {
        const Next next = *std::exchange(next_, std::nullopt);
        lock.unlock();
        write(next);
        lock.lock();
    }
}

void NewestFile::write(const Next& next) {
    std::error_code ignored;  // the folder may have been removed, or its disk mounted later
    std::filesystem::create_directories(path_.parent_path(), ignored);
    const auto written = replace_text_file(path_, next.text());
    if (written) { kept_ = next.number; }
    if (!written && !failed_) { on_failure_(written.error()); }
    failed_ = !written;
}

}  // namespace lockstep
