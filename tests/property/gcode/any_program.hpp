// Random lines and programs from a seed, with every word of the language, and many with an error.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>

namespace lockstep {

class AnyProgram {
public:
    explicit AnyProgram(std::uint32_t seed) : random_(seed) {}

    /// Without its line end.
    std::string line();
    /// Lines with compensated contours, branches, loops and subroutines.
    std::string text();

private:
    int pick(int least, int most) { return std::uniform_int_distribution(least, most)(random_); }
    bool one_in(int count) { return pick(1, count) == 1; }
    std::string one_of(std::span<const std::string_view> texts) {
        return std::string(texts[static_cast<std::size_t>(pick(0, static_cast<int>(texts.size()) - 1))]);
    }
    /// One of the words of a text, between spaces.
    std::string word_of(std::string_view words);

    std::string number();
    std::string parameter();
    std::string expression(int depth);
    std::string value();
    std::string words(std::string_view letters);
    std::string axes() { return words(one_in(6) ? "XYZABCUVW" : "XYZ"); }
    /// `pattern`, with a value behind each letter that ends a word: "G2 X Y I J".
    std::string filled(std::string_view pattern);
    std::string statement();
    std::string assignment();
    std::string condition();
    std::string garbage();
    std::string with_noise(std::string line);
    std::string body(int depth);
    std::string contour();
    std::string flow(int depth);
    std::string label();

    std::mt19937 random_;
    int labels_ = 0;
};

}  // namespace lockstep
