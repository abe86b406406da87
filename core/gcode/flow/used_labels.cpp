#include "core/gcode/flow/used_labels.hpp"

namespace lockstep::gcode {

std::optional<GcodeError> UsedLabels::open(std::string subroutine, const OWord& word, const Line& line) {
    if (!word.label) { return word.label.error(); }
    const auto [before, is_new] =
        openings_.try_emplace({std::move(subroutine), *word.label}, Opening{word.keyword, line.number()});
    const bool is_do_again = word.keyword == Keyword::Do && before->second.keyword == Keyword::Do;
    if (!is_new && before->second.line != line.number() && !is_do_again) {
        return line.error(word.place, shown_label(word) + " is the label of an earlier O-word, in line " +
                                          std::to_string(before->second.line) + "; use another label");
    }
    if (openings_.size() <= most_) { return std::nullopt; }
    return line.error(word.place, shown_label(word) + " is one of more than " + std::to_string(most_) +
                                      " labels that the program computes; use fewer");
}

}  // namespace lockstep::gcode
