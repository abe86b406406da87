// Reads the lines of a file to send, each with its number in the file.
#pragma once

#include <expected>
#include <optional>
#include <string>
#include <string_view>

#include "clients/sender/line_flow.hpp"
#include "services/files/diagnostic.hpp"
#include "services/files/line_reader.hpp"

namespace lockstep {

class FileLines {
public:
    /// "-" is standard input.
    static std::expected<FileLines, Diagnostic> open(const std::string& path);

    /// The next line that is not empty; nullopt if there is none now. Fails if the line cannot be read or sent.
    std::expected<std::optional<sender::Line>, Diagnostic> next();
    bool is_at_end() const { return is_at_end_; }
    double share_read() const { return reader_.share_read(); }

    /// The error of the first line that cannot be sent; nullopt if all can be sent.
    static std::optional<Diagnostic> check(const std::string& path);

private:
    explicit FileLines(LineReader reader) : reader_(std::move(reader)) {}

    bool is_end(std::string_view raw, std::string_view text);

    LineReader reader_;
    bool has_begun_ = false;
    int number_ = 0;
    bool is_at_end_ = false;
};

}  // namespace lockstep
