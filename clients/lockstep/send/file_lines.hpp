// The lines of a file that are to be sent, each with its number in the file.
#pragma once

#include <expected>
#include <optional>
#include <string>

#include "clients/sender/line_flow.hpp"
#include "services/files/diagnostic.hpp"
#include "services/files/line_reader.hpp"

namespace lockstep {

class FileLines {
public:
    /// "-": standard input.
    static std::expected<FileLines, Diagnostic> open(const std::string& path);

    /// The next line that is not empty; nothing: there is none now. Error: it cannot be sent, or read.
    std::expected<std::optional<sender::Line>, Diagnostic> next();
    bool is_at_end() const { return is_at_end_; }
    double share_read() const { return reader_.share_read(); }

    /// The first line of the file that cannot be sent. Nothing: all can be.
    static std::optional<Diagnostic> check(const std::string& path);

private:
    explicit FileLines(LineReader reader) : reader_(std::move(reader)) {}

    LineReader reader_;
    int number_ = 0;
    bool is_at_end_ = false;
};

}  // namespace lockstep
