// Makes random lines of G-code that are mostly valid. Keeps the modes that earlier lines have set.
#pragma once

#include <array>
#include <cstdint>
#include <random>
#include <string>

namespace lockstep::oracle {

class LineMaker {
public:
    /// `is_plain`: without the tool table and without splines.
    explicit LineMaker(std::uint32_t seed, bool is_plain = false)
        : random_(seed), rotates_(one_in(3)), changes_units_(one_in(3)), is_plain_(is_plain) {}

    /// A block without its line's end.
    std::string block();
    /// A line that prints the axes' places as the program reads them.
    static std::string report() { return "(debug,#5420 #5421 #5422 #5423 #5424 #5425)"; }
    /// A word that may be invalid in the line into which it is put.
    std::string odd_word();
    /// In a loop or a branch (nested) a line may run again or not at all. It then changes nothing that later lines
    /// need.
    bool changes_units() const { return changes_units_; }
    void set_nested(bool nested) { nested_ = nested; }

    int below(int limit) { return static_cast<int>(random_() % static_cast<std::uint32_t>(limit)); }
    bool one_in(int count) { return below(count) == 0; }
    std::string value(double from, double to);

private:
    std::string number(double value);
    double drawn(double from, double to);
    std::string feed();
    std::string straight();
    std::string axis_words(const std::string& letters, double reach);
    std::string arc();
    std::string centre_word(char letter, int axis, double offset);
    std::string end_word(char letter, int axis, double offset);
    std::string arc_by_radius();
    double other_radius(double radius);
    std::string compensated();
    std::string cycle();
    std::string spline();
    std::string mode();
    std::string offset();
    std::string rotation();
    std::string tool();
    std::string plain_tool();
    std::string event();
    std::string assignment();
    std::string home();

    // A path in a plane with cutter compensation: cutter_lines.cpp. `at` is where it is, in the program's coordinates.
    struct PathEnd {
        std::array<int, 2> axes{};
        std::array<double, 2> at{};
    };
    std::string end_words(PathEnd& path, std::array<double, 2> step);
    std::string cutter_on();
    std::string cutter_straight(PathEnd& path);
    std::string cutter_arc(PathEnd& path, double least_angle, double most_angle);

    std::mt19937 random_;
    bool rotates_;
    bool changes_units_;
    bool is_plain_;
    bool nested_ = false;
    bool relative_ = false;
    bool inches_ = false;
    bool centres_absolute_ = false;
    bool inverse_time_ = false;
    bool has_feed_ = false;
    int plane_ = 0;
};

}  // namespace lockstep::oracle
