#include "core/gcode/line_words.hpp"

#include <algorithm>
#include <cmath>

#include "core/number_text.hpp"

namespace lockstep::gcode {
namespace {

constexpr std::string_view kOtherLetters = "DEFHIJKLPQRST";

std::string spaced(std::string_view letters) {
    std::string text;
    for (const char letter : letters) { text += (text.empty() ? "" : " ") + std::string(1, letter); }
    return text.empty() ? "none with a G-code letter" : text;
}

class BlockReader {
public:
    BlockReader(Reader& reader, const Line& line, std::string_view axes, LineWords& block)
        : reader_(reader), line_(line), axes_(axes), block_(block) {}

    std::optional<GcodeError> read() {
        while (!reader_.done()) { take_word(); }
        return reader_.error();
    }

private:
    void take_word() {
        const std::size_t place = reader_.place();
        const char letter = reader_.next();
        if (letter == 'G' || letter == 'M') { return take_code(letter, place); }
        if (is_letter(letter)) { return take_letter(letter, place); }
        switch (letter) {
            case '(':
                reader_.go_to(place);
                block_.comment = place;
                return reader_.skip_comment();
            case '#': return take_assignment();
            case '@': return take_polar(block_.distance, place);
            case '^': return take_polar(block_.angle, place);
            case '*': return take_checksum(place);
            default: reader_.fail(place, shown(letter) + " where a word's letter is expected");
        }
    }

    void take_letter(char letter, std::size_t place) {
        if (axes_.find(letter) == std::string_view::npos && kOtherLetters.find(letter) == std::string_view::npos) {
            return refuse_letter(letter, place);
        }
        const double value = reader_.word_value(place);
        if (reader_.error()) { return; }
        if (block_.has(letter)) {
            return reader_.fail(place, word_text(line_, place) + " repeats " + word_text(line_, block_.place(letter)) +
                                           "; a block has each word once");
        }
        if (std::abs(value) > kMaxNumber && letter != 'F' && letter != 'S') { return refuse_size(place); }
        block_.set(letter, value, place);
    }

    void refuse_letter(char letter, std::size_t place) {
        const std::string text = word_text(line_, place);
        if (letter == 'N') { return reader_.fail(place, text + " is a line number and must come first in its block"); }
        if (kAxisLetters.find(letter) != std::string_view::npos) {
            return reader_.fail(place,
                                text + ": this machine has no axis " + letter + "; its axes are " + spaced(axes_));
        }
        reader_.fail(place, text + " is not a word of this machine; its words are G M N O " + spaced(kOtherLetters) +
                                " and the axes " + spaced(axes_));
    }

    void refuse_size(std::size_t place) {
        reader_.fail(place, word_text(line_, place) + " is out of range; a number must be from -" +
                                number_text(kMaxNumber) + " to " + number_text(kMaxNumber));
    }

    void take_code(char letter, std::size_t place) {
        const double tenths = reader_.word_value(place) * 10;
        if (reader_.error()) { return; }
        const double whole = std::round(tenths);
        const bool is_one = std::abs(tenths - whole) < 0.01 && whole >= 0 && whole < 1e6;
        const Code* code = is_one ? find_code(letter, static_cast<int>(whole)) : nullptr;
        if (code == nullptr) { return refuse_code(letter, is_one ? static_cast<int>(whole) : -1, place); }
        m_codes_ += letter == 'M' ? 1 : 0;
        if (m_codes_ > kMaxMCodes) {
            return reader_.fail(place, word_text(line_, place) + " is one M code more than the " +
                                           std::to_string(kMaxMCodes) + " that a block can have; use two lines");
        }
        if (block_.has(code->group) && !cancels(*code)) { return refuse_group(*code, place); }
        block_.set(*code, place);
    }

    /// If a block has G80 and another motion word, the other one counts.
    bool cancels(const Code& code) {
        constexpr int kCancel = 800;
        if (code.group != Group::Motion) { return false; }
        return block_.code(Group::Motion) == kCancel || code.tenths == kCancel;
    }

    void refuse_code(char letter, int tenths, std::size_t place) {
        const std::string text = word_text(line_, place);
        if (const RefusedCode* refused = find_refused(letter, tenths)) {
            return reader_.fail(place, text + " " + std::string(refused->reason));
        }
        reader_.fail(place, text + " is not a code of this machine; remove it, or see the list of codes");
    }

    void refuse_group(const Code& code, std::size_t place) {
        reader_.fail(place, word_text(line_, place) + " after " + word_text(line_, block_.place(code.group)) +
                                ": a block has one " + std::string(name_of(code.group)) + " word; use two lines");
    }

    void take_assignment() {
        Assignment assignment;
        const std::size_t place = reader_.place();
        if (reader_.peek() == '<') {
            assignment.parameter = reader_.name();
        } else {
            assignment.parameter = reader_.parameter_number();
        }
        if (!reader_.error() && !reader_.take('=')) {
            return reader_.fail(place - 1, "a parameter alone on its line does nothing; write = and its value");
        }
        assignment.value = reader_.error() ? 0 : reader_.value();
        block_.assignments.push_back(std::move(assignment));
    }

    void take_polar(std::optional<double>& coordinate, std::size_t place) {
        if (coordinate) {
            return reader_.fail(place, shown(line_.at(place)) + " is twice in the block; write it once");
        }
        coordinate = reader_.word_value(place);
        if (std::abs(*coordinate) > kMaxNumber) { refuse_size(place); }
    }

    /// Some senders add a checksum: the exclusive or of all bytes before the *.
    void take_checksum(std::size_t place) {
        const double given = reader_.word_value(place);
        if (!reader_.error() && given != line_.checksum()) {
            reader_.fail(place, word_text(line_, place) + " is not the line's checksum, " +
                                    std::to_string(line_.checksum()) +
                                    "; the line was damaged in transmission; send it again");
        }
    }

    Reader& reader_;
    const Line& line_;
    std::string_view axes_;
    LineWords& block_;
    int m_codes_ = 0;
};

}  // namespace

void LineWords::clear() {
    present_ = 0;
    codes_.fill(kNoCode);
    assignments.clear();
    comment.reset();
    distance.reset();
    angle.reset();
}

bool LineWords::has_any(std::string_view letters) const {
    return std::ranges::any_of(letters, [this](char letter) { return has(letter); });
}

void LineWords::set(char letter, double value, std::size_t place) {
    present_ |= letter_bit(letter);
    values_[index(letter)] = value;
    places_[index(letter)] = static_cast<std::uint16_t>(place);
}

void LineWords::set(const Code& code, std::size_t place) {
    constexpr int kCancel = 800;
    const auto group = static_cast<std::size_t>(code.group);
    if (code.tenths == kCancel && code.group == Group::Motion && codes_[group] != kNoCode) { return; }
    codes_[group] = static_cast<std::int16_t>(code.tenths);
    code_places_[group] = static_cast<std::uint16_t>(place);
}

bool skip_head(const Line& line, Reader& reader, bool skip_deletable) {
    std::size_t place = 0;
    while (line.at(place) == '(') { place = line.end_of_comment(place); }
    if (line.at(place) == '/') { reader.go_to(place); }
    const bool is_deletable = reader.take('/');
    const std::size_t begin = reader.place();
    if (reader.take('N')) {
        if (!is_of_number(reader.peek())) {
            reader.fail(begin, word_text(line, begin) + " is not a line number; a line number must be 0 or above");
            return true;
        }
        (void)reader.word_value(begin);
    }
    return !(is_deletable && skip_deletable);
}

std::optional<GcodeError> read_block(Reader& reader, const Line& line, std::string_view axes, LineWords& block) {
    block.line = line.number();
    return BlockReader(reader, line, axes, block).read();
}

std::string word_text(const Line& line, std::size_t place) {
    const std::string_view text = line.text();
    std::size_t end = place + 1;
    int depth = 0;
    while (end < text.size() && (depth > 0 || (!is_letter(text[end]) && text[end] != '('))) {
        depth += text[end] == '[' ? 1 : 0;
        depth -= text[end] == ']' ? 1 : 0;
        ++end;
    }
    return std::string(text.substr(place, end - place));
}

}  // namespace lockstep::gcode
