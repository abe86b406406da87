#include "clients/lockstep/send/file_lines.hpp"

#include <algorithm>
#include <utility>

#include "clients/sender/line_text.hpp"

namespace lockstep {

std::expected<FileLines, Diagnostic> FileLines::open(const std::string& path) {
    auto reader = LineReader::open(path);
    if (!reader) { return std::unexpected(Diagnostic{.message = "cannot be read: " + reader.error()}); }
    return FileLines(*std::move(reader));
}

/// A % ends the program, unless it is the first line that is not empty.
bool FileLines::is_end(std::string_view raw, std::string_view text) {
    const std::string_view line = raw.substr(std::min(raw.find_first_not_of(" \t\r"), raw.size()));
    const bool is_behind_first = has_begun_ && line.starts_with('%');
    has_begun_ = has_begun_ || line.starts_with('%') || !text.empty();
    return is_behind_first || sender::ends_program(text);
}

/// Text behind the end of the program is not sent, as `lockstep run` ignores it.
std::expected<std::optional<sender::Line>, Diagnostic> FileLines::next() {
    while (!is_at_end_) {
        const auto read = reader_.next();
        if (!read) { return std::unexpected(Diagnostic{.message = read.error()}); }
        if (read->state == LineReader::State::Ends) { is_at_end_ = true; }
        if (read->state != LineReader::State::Line) { return std::nullopt; }
        ++number_;
        auto text = sender::line_to_send(read->line);
        is_at_end_ = text && is_end(read->line, *text);
        if (!text) { return std::unexpected(Diagnostic{number_, 1, text.error()}); }
        if (!text->empty()) { return sender::Line{number_, *std::move(text)}; }
    }
    return std::nullopt;
}

std::optional<Diagnostic> FileLines::check(const std::string& path) {
    auto lines = open(path);
    if (!lines) { return lines.error(); }
    while (!lines->is_at_end()) {
        if (const auto line = lines->next(); !line) { return line.error(); }
    }
    return std::nullopt;
}

}  // namespace lockstep
