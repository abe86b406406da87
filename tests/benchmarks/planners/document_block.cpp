#include "tests/benchmarks/planners/document_block.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <vector>

namespace lockstep::planners {
namespace {

constexpr double kShare = 0.005;
constexpr double kLeast = 0.011;

struct Place {
    std::size_t begin = 0;
    std::size_t end = 0;
};

std::expected<Place, std::string> place_of(std::string_view document) {
    const std::size_t begin = document.find(kBlockBegin);
    const std::size_t end = document.find(kBlockEnd, begin);
    if (begin == std::string_view::npos || end == std::string_view::npos) {
        return std::unexpected("the document has no comments between which to write");
    }
    return Place{begin + kBlockBegin.size(), end};
}

std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line);
    std::vector<std::string> words;
    for (std::string word; in >> word;) { words.push_back(word); }
    return words;
}

std::optional<double> number_of(const std::string& word) {
    std::size_t used = 0;
    try {
        const double value = std::stod(word, &used);
        return used == word.size() ? std::optional(value) : std::nullopt;
    } catch (const std::exception&) { return std::nullopt; }
}

bool is_same(const std::string& a, const std::string& b) {
    const auto x = number_of(a);
    const auto y = number_of(b);
    if (!x || !y) { return a == b; }
    return std::abs(*x - *y) <= std::max(kShare * std::abs(*x), kLeast);
}

}  // namespace

std::expected<std::string, std::string> block_of(std::string_view document) {
    const auto place = place_of(document);
    if (!place) { return std::unexpected(place.error()); }
    return std::string(document.substr(place->begin, place->end - place->begin));
}

std::expected<std::string, std::string> with_block(std::string_view document, std::string_view block) {
    const auto place = place_of(document);
    if (!place) { return std::unexpected(place.error()); }
    return std::string(document.substr(0, place->begin)) + std::string(block) +
           std::string(document.substr(place->end));
}

std::string first_difference(std::string_view written, std::string_view now) {
    std::istringstream old_lines{std::string(written)};
    std::istringstream new_lines{std::string(now)};
    std::string a;
    std::string b;
    while (true) {
        const bool has_old = static_cast<bool>(std::getline(old_lines, a));
        const bool has_new = static_cast<bool>(std::getline(new_lines, b));
        if (!has_old && !has_new) { return {}; }
        const bool is_equal = has_old && has_new && std::ranges::equal(words_of(a), words_of(b), is_same);
        if (!is_equal) { return "written: " + (has_old ? a : "nothing") + "\nnow:     " + (has_new ? b : "nothing"); }
    }
}

}  // namespace lockstep::planners
