#include "clients/lockstep/send/file_lines.hpp"

#include <utility>

#include "clients/sender/line_text.hpp"

namespace lockstep {

std::expected<FileLines, Diagnostic> FileLines::open(const std::string& path) {
    auto reader = LineReader::open(path);
    if (!reader) { return std::unexpected(Diagnostic{.message = "cannot be read: " + reader.error()}); }
    return FileLines(*std::move(reader));
}

std::expected<std::optional<sender::Line>, Diagnostic> FileLines::next() {
    for (;;) {
        const auto read = reader_.next();
        if (!read) { return std::unexpected(Diagnostic{.message = read.error()}); }
        if (read->state == LineReader::State::Ends) { is_at_end_ = true; }
        if (read->state != LineReader::State::Line) { return std::nullopt; }
        ++number_;
        auto text = sender::line_to_send(read->line);
        if (!text) { return std::unexpected(Diagnostic{number_, 1, text.error()}); }
        if (!text->empty()) { return sender::Line{number_, *std::move(text)}; }
    }
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
