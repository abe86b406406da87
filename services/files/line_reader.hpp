// Reads the lines of a file or a pipe, a part at a time, whatever ends them: LF, CR LF, CR CR LF, CR, or the end.
#pragma once

#include <cstdint>
#include <expected>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace lockstep {

class LineReader {
public:
    /// "-": standard input. Error: it cannot be opened.
    static std::expected<LineReader, std::string> open(const std::string& path);
    LineReader(LineReader&& other) noexcept;
    LineReader& operator=(LineReader&&) = delete;
    ~LineReader();

    enum class State : std::uint8_t { Line, Waits, Ends };
    struct Next {
        State state = State::Ends;
        std::string_view line;  // until the next call
    };
    /// Waits: of a pipe nothing is there now. Error: it cannot be read any more, or has become shorter; why.
    std::expected<Next, std::string> next();

    /// Of the file, 0 to 1; 0 of a pipe.
    double share_read() const;
    std::uint64_t bytes() const { return bytes_; }

    static constexpr std::size_t kMostLineBytes = 1 << 20;

private:
    explicit LineReader(int file, std::string name);
    std::expected<bool, std::string> fill();
    std::optional<std::string_view> cut_line();

    int file_ = -1;
    std::string name_;
    bool is_file_ = false;
    std::uint64_t bytes_ = 0;  // of the file, when it was opened
    std::uint64_t read_ = 0;
    std::string buffer_;
    std::size_t at_ = 0;  // the next line in it
    bool is_at_end_ = false;
    bool is_begun_ = false;
};

}  // namespace lockstep
