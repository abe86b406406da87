// Reads the lines of a file or a pipe, a part at a time. A line ends with LF, CR LF, CR CR LF, CR, or the end of the
// file.
#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "services/files/descriptor.hpp"

namespace lockstep {

class LineReader {
public:
    /// "-" is standard input. Error: why the file cannot be opened.
    static std::expected<LineReader, std::string> open(const std::string& path);

    /// The lines of a text in memory.
    static LineReader of_text(std::string text);

    enum class State : std::uint8_t { Line, Waits, Ends };
    struct Next {
        State state = State::Ends;
        std::string_view line;  // valid until the next call
    };
    /// Returns Waits if a pipe has no data now. Error: why the file can no longer be read, or that it has become
    /// shorter.
    std::expected<Next, std::string> next();

    /// The share of the file that was read, 0 to 1; for a pipe 0.
    double share_read() const;
    std::uint64_t bytes() const { return bytes_; }

    static constexpr std::size_t kMostLineBytes = 1 << 20;

private:
    LineReader(Descriptor file, std::string name);
    std::expected<bool, std::string> fill();
    std::optional<std::string_view> cut_line();

    Descriptor file_;
    std::string name_;
    bool is_file_ = false;
    std::uint64_t bytes_ = 0;  // size of the file when it was opened
    std::uint64_t read_ = 0;
    std::string buffer_;
    std::size_t at_ = 0;  // where the next line begins
    bool is_at_end_ = false;
    bool is_begun_ = false;
};

}  // namespace lockstep
