// An optional value that keeps its memory while it is absent.
#include "core/reused_optional.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lockstep {
namespace {

struct NumberedText {
    int number = 0;
    std::string text;
};

TEST(ReusedOptional, AValueThatIsMadeAgainTakesMemoryAndNoOldValue) {
    ReusedOptional<NumberedText> note;
    EXPECT_FALSE(note.has_value());
    note.renew([](NumberedText&&) { return NumberedText{.number = 7, .text = std::string(100, 'a')}; });
    const char* const memory = note->text.data();
    note.reset();
    EXPECT_FALSE(note);
    note.renew([](NumberedText&& old) {
        old.text.clear();
        return NumberedText{.text = std::move(old.text)};
    });
    EXPECT_EQ(note->number, 0) << "a field that is not named has its default";
    EXPECT_EQ(note->text.data(), memory);
}

TEST(ReusedOptional, CopiesItsValueOnlyIfThereIsOne) {
    ReusedOptional<NumberedText> note;
    note.renew([](NumberedText&&) { return NumberedText{.number = 7}; });
    ReusedOptional<NumberedText> copy = note;
    EXPECT_EQ(copy->number, 7);
    note.reset();
    copy = note;
    EXPECT_FALSE(copy.has_value());
}

TEST(ReusedOptionalDeathTest, AValueThatIsNotThereIsAFailedCheck) {
    ReusedOptional<NumberedText> note;
    EXPECT_DEATH(*note, "a value that is used is there");
    note.renew([](NumberedText&&) { return NumberedText{.number = 7}; });
    note.reset();
    EXPECT_DEATH(note->number = 1, "a value that is used is there");
}

}  // namespace
}  // namespace lockstep
