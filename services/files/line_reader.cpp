#include "services/files/line_reader.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "services/files/access.hpp"

namespace lockstep {
namespace {

constexpr std::size_t kAtOnce = 1 << 18;

std::unexpected<std::string> failure(const std::string& name) {
    return std::unexpected(name + ": " + why_not_read(name, errno));
}

}  // namespace

std::expected<LineReader, std::string> LineReader::open(const std::string& path) {
    const bool is_pipe = path == "-";
    Descriptor file(is_pipe ? fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!file.is_open()) { return failure(path); }
    return LineReader(std::move(file), is_pipe ? "standard input" : path);
}

LineReader::LineReader(Descriptor file, std::string name) : file_(std::move(file)), name_(std::move(name)) {
    struct stat status {};
    is_file_ = fstat(file_.get(), &status) == 0 && S_ISREG(status.st_mode);
    bytes_ = is_file_ ? static_cast<std::uint64_t>(status.st_size) : 0;
}

LineReader LineReader::of_text(std::string text) {
    LineReader reader(Descriptor(), "the text");
    reader.bytes_ = reader.read_ = text.size();
    reader.buffer_ = std::move(text);
    reader.is_at_end_ = true;
    return reader;
}

double LineReader::share_read() const {
    if (bytes_ == 0) { return 0; }
    return std::min(1.0, static_cast<double>(read_ - (buffer_.size() - at_)) / static_cast<double>(bytes_));
}

/// Reads the next bytes. Returns false if none are available now.
std::expected<bool, std::string> LineReader::fill() {
    pollfd wait{.fd = file_.get(), .events = POLLIN, .revents = 0};
    if (!is_file_ && poll(&wait, 1, 0) == 0) { return false; }
    buffer_.erase(0, std::exchange(at_, 0));
    const std::size_t before = buffer_.size();
    buffer_.resize(before + kAtOnce);
    const ssize_t size = ::read(file_.get(), buffer_.data() + before, kAtOnce);
    buffer_.resize(before + static_cast<std::size_t>(std::max<ssize_t>(size, 0)));
    if (size < 0 && (errno == EINTR || errno == EAGAIN)) { return false; }
    if (size < 0) { return failure(name_); }
    read_ += static_cast<std::uint64_t>(size);
    is_at_end_ = size == 0;
    if (is_at_end_ && is_file_ && read_ < bytes_) {
        return std::unexpected(name_ + ": it has become shorter while it was read");
    }
    return true;
}

/// Returns nullopt if the end of the line has not been read yet.
std::optional<std::string_view> LineReader::cut_line() {
    const std::string_view rest = std::string_view(buffer_).substr(at_);
    const std::size_t end = rest.find('\n');
    if (end == std::string_view::npos && !is_at_end_) { return std::nullopt; }
    std::string_view line = rest.substr(0, end);
    std::size_t next = line.size() + (end == std::string_view::npos ? 0 : 1);
    if (const std::size_t carriage = line.find('\r'); carriage != std::string_view::npos) {
        const bool only_returns = line.substr(carriage).find_first_not_of('\r') == std::string_view::npos;
        next = only_returns ? next : carriage + 1;
        line = line.substr(0, carriage);
    }
    at_ += next;
    return line;
}

std::expected<LineReader::Next, std::string> LineReader::next() {
    constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
    for (;;) {
        if (!std::exchange(is_begun_, is_begun_ || buffer_.size() >= kByteOrderMark.size()) &&
            buffer_.starts_with(kByteOrderMark)) {
            at_ = kByteOrderMark.size();
        }
        if (is_at_end_ && at_ == buffer_.size()) { return Next{State::Ends, {}}; }
        if (at_ < buffer_.size()) {
            if (const auto line = cut_line()) { return Next{State::Line, *line}; }
        }
        if (buffer_.size() - at_ > kMostLineBytes) {
            return std::unexpected(fmt::format("{}: a line is longer than {} bytes", name_, kMostLineBytes));
        }
        const auto filled = fill();
        if (!filled) { return std::unexpected(filled.error()); }
        if (!*filled) { return Next{State::Waits, {}}; }
    }
}

}  // namespace lockstep
