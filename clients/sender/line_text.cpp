#include "clients/sender/line_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "core/parse_number.hpp"

namespace lockstep::sender {
namespace {

std::string without_comments(std::string_view line) {
    std::string text;
    bool is_in = false;
    for (const char c : line) {
        if (!is_in && c == ';') { break; }
        if (c == '(') { is_in = true; }
        if (!is_in) { text += c; }
        if (c == ')') { is_in = false; }
    }
    return text;
}

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view kBlank = " \t\r\n\v\f";
    text.remove_prefix(std::min(text.find_first_not_of(kBlank), text.size()));
    return text.substr(0, text.find_last_not_of(kBlank) + 1);
}

bool is_obeyed(unsigned char byte) { return byte == '!' || byte == '?' || byte == '~' || byte == 0x18 || byte > 0x7F; }

std::string name_of(unsigned char byte) {
    return byte > 0x20 && byte < 0x7F ? fmt::format("'{:c}'", byte) : fmt::format("0x{:02X}", byte);
}

/// In capitals, without blanks.
std::string capitals(std::string_view line) {
    std::string text;
    for (const char c : line) {
        if (std::isspace(static_cast<unsigned char>(c)) == 0) {
            text += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        }
    }
    return text;
}

}  // namespace

std::expected<std::string, std::string> line_to_send(std::string_view line) {
    const std::string plain = without_comments(line);
    const std::string_view text = trimmed(plain);
    if (text == "%") { return ""; }
    const auto found = std::ranges::find_if(text, [](char c) { return is_obeyed(static_cast<unsigned char>(c)); });
    if (found == text.end()) { return std::string(text); }
    return std::unexpected("the byte " + name_of(static_cast<unsigned char>(*found)) +
                           " is a command to the controller wherever it stands; remove it");
}

bool is_sent_alone(std::string_view line) {
    if (line.starts_with('$')) { return true; }
    const std::string text = capitals(line);
    for (const std::string_view word : {"G10L", "G28.1", "G30.1"}) {
        if (text.find(word) != std::string::npos) { return true; }
    }
    return false;
}

bool ends_program(std::string_view line) {
    const std::string text = capitals(line);
    if (text.starts_with('/')) { return false; }
    bool is_name = false;
    for (std::size_t at = 0; at < text.size(); ++at) {
        if (text[at] == '<' || text[at] == '>') { is_name = text[at] == '<'; }
        if (is_name || text[at] != 'M') { continue; }
        const std::size_t end = std::min(text.find_first_not_of("0123456789.", at + 1), text.size());
        const auto number = parse_number<double>(std::string_view(text).substr(at + 1, end - at - 1));
        if (number == 2.0 || number == 30.0) { return true; }
    }
    return false;
}

}  // namespace lockstep::sender
