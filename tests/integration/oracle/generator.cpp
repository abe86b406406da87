#include "tests/integration/oracle/generator.hpp"

#include "tests/integration/oracle/line_maker.hpp"

namespace lockstep::oracle {
namespace {

constexpr int kLines = 30;

class ProgramMaker {
public:
    explicit ProgramMaker(std::uint32_t seed, bool is_plain = false) : lines_(seed, is_plain), is_plain_(is_plain) {}

    std::string make() {
        text_ = lines_.one_in(3) ? "%\n" : "";
        if (lines_.one_in(3)) { add("O000" + std::to_string(lines_.below(9)) + (lines_.one_in(2) ? " (PART)" : "")); }
        text_ += "#1=3 #2=4 #4=5\n#<name>=1.5\nG0\n";
        if (!is_plain_ && !lines_.changes_units() && lines_.one_in(3)) { text_ += "T2 M6\nG43\n"; }
        if (lines_.one_in(2)) { subroutine(); }
        calls_later_ = lines_.one_in(4);
        for (int i = 0; i < kLines; ++i) { statement(0); }
        add(LineMaker::report());
        add("M2");
        if (calls_later_) { later_subroutine(); }
        return text_;
    }

private:
    void add(const std::string& block) {
        if (lines_.one_in(12)) { text_ += "N" + std::to_string(lines_.below(9999)) + " "; }
        text_ += block + (lines_.one_in(20) ? " ; text" : "") + (lines_.one_in(30) ? "\r\n" : "\n");
    }

    void some(int depth) {
        const int count = 1 + lines_.below(3);
        for (int i = 0; i < count; ++i) { statement(depth); }
    }

    void statement(int depth) {
        if (depth < 3 && lines_.one_in(9)) { return flow(depth); }
        add(lines_.block());
        if (lines_.one_in(3)) { add(LineMaker::report()); }
    }

    std::string label() {
        const std::string number = std::to_string(++labels_);
        if (!lines_.one_in(4)) { return "o" + number; }
        return lines_.one_in(2) ? "o[" + number + " + #2 * 0]" : "o[#4 * 0 + " + number + "]";
    }

    void flow(int depth) {
        lines_.set_nested(true);
        const std::string name = label();
        if (calls_later_ && depth == 0 && lines_.one_in(4)) {
            add("o<later> call [" + lines_.value(1, 9) + "]");
            return lines_.set_nested(false);
        }
        switch (lines_.below(has_subroutine_ && depth == 0 ? 6 : 4)) {
            case 0: branch(name, depth); break;
            case 1:
                add("#5=0");
                add(name + " while [#5 lt " + std::to_string(lines_.below(3)) + "]");
                add("#5=[#5+1]");
                one_level(depth);
                add(name + " endwhile");
                break;
            case 2:
                add(name + " repeat [" + std::to_string(lines_.below(3)) + "]");
                some(depth + 1);
                add(name + " endrepeat");
                break;
            case 3: count_down(name, depth); break;
            default: {
                const std::string comment = lines_.one_in(2) ? "(c)" : "";
                add("o<part> call " + comment + "[" + lines_.value(1, 9) + "]" + comment + " [" + lines_.value(1, 9) +
                    "]");
            }
        }
        lines_.set_nested(depth > 0);
    }

    /// Lines without loops, which would use the same counter.
    void one_level(int depth) {
        (void)depth;
        add(lines_.block());
        add(LineMaker::report());
    }

    void branch(const std::string& name, int depth) {
        if (lines_.one_in(3)) { return same_label_twice(name); }
        add(name + " if [#1 gt " + lines_.value(-9, 9) + "]");
        some(depth + 1);
        if (lines_.one_in(2)) {
            add(name + " elseif [#2 lt " + lines_.value(-9, 9) + "]");
            some(depth + 1);
        }
        if (lines_.one_in(2)) {
            add(name + " else");
            some(depth + 1);
        }
        add(name + " endif");
    }

    /// Only one of the two inner branches runs.
    void same_label_twice(const std::string& name) {
        const std::string inner = label();
        const std::string condition = " if [exists[#" + std::to_string(lines_.below(2)) + "]]";
        add(name + " if [#1 gt " + lines_.value(-9, 9) + "]");
        for (const char* next : {" else", " endif"}) {
            add(inner + condition);
            one_level(0);
            add(inner + " endif");
            add(name + next);
        }
    }

    void count_down(const std::string& name, int depth) {
        const std::string inner = label();
        add("#6=3");
        if (depth == 0 && lines_.one_in(3)) { add(name + " do\n" + name + " while [0]"); }
        add(name + " do");
        add("#6=[#6-1]");
        add(inner + " if [#6 eq " + std::to_string(lines_.below(4)) + "]");
        add(name + " break");  // not continue: see the list in oracle_test.cpp
        add(inner + " endif");
        one_level(depth);
        add(name + " while [#6 gt 0]");
    }

    void subroutine() {
        lines_.set_nested(true);
        add("o<part> sub");
        if (!lines_.changes_units() && lines_.one_in(2)) { add("M73"); }
        add("#<own>=[#1+#2]");
        add("G1 X#<own> Y#2 F100");
        add(LineMaker::report());
        if (lines_.one_in(2)) { add("o<part> return [#1]"); }
        add("o<part> endsub [#1*2]");
        lines_.set_nested(false);
        has_subroutine_ = true;
    }

    /// Adds a subroutine after the program's end, where its calls find it.
    void later_subroutine() {
        add("o<later> sub");
        add("G1 X#1 F100");
        add(LineMaker::report());
        add("o<later> endsub");
    }

    LineMaker lines_;
    bool is_plain_;
    std::string text_;
    int labels_ = 100;
    bool has_subroutine_ = false;
    bool calls_later_ = false;
};

}  // namespace

std::string valid_program(std::uint32_t seed) { return ProgramMaker(seed).make(); }

std::string plain_program(std::uint32_t seed) { return ProgramMaker(seed, true).make(); }

std::string odd_program(std::uint32_t seed) {
    LineMaker lines(seed);
    std::string text = "#1=3 #2=4 #4=5\n#<name>=1.5\nG0 X1 Y2 F100 S5\n";
    for (int i = 0; i < 4; ++i) { text += lines.block() + "\n"; }
    std::string odd = lines.block();
    const std::size_t begin = odd.rfind('\n') == std::string::npos ? 0 : odd.rfind('\n') + 1;
    const std::string word = lines.odd_word();
    if (lines.one_in(3)) {
        odd.insert(begin, word + " ");
    } else {
        odd += " " + word;
    }
    return text + odd + "\n" + LineMaker::report() + "\n" + lines.block() + "\nM2\n";
}

}  // namespace lockstep::oracle
