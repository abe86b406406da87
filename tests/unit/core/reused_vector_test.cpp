// A vector that keeps its elements' memory when it is cleared.
#include "core/reused_vector.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lockstep {
namespace {

TEST(ReusedVector, KeepsTheMemoryOfItsElements) {
    ReusedVector<std::string> texts;
    texts.push_back(std::string(100, 'a'));
    const char* const memory = texts[0].data();
    texts.clear();
    EXPECT_TRUE(texts.empty());
    texts.push_back("short");
    EXPECT_EQ(texts[0], "short");
    EXPECT_EQ(texts[0].data(), memory);
}

TEST(ReusedVector, AnElementThatIsMadeAgainTakesMemoryAndNoOldValue) {
    struct Note {
        int number = 0;
        std::string text;
    };
    ReusedVector<Note> notes;
    notes.push_back({7, std::string(100, 'a')});
    const char* const memory = notes[0].text.data();
    notes.clear();
    const Note& note = notes.renew_back([](Note&& old) {
        old.text.clear();
        return Note{.text = std::move(old.text)};
    });
    EXPECT_EQ(note.number, 0) << "a field that is not named has its default";
    EXPECT_EQ(note.text, "");
    EXPECT_EQ(note.text.data(), memory);
}

TEST(ReusedVector, CopiesAndMovesOnlyWhatIsInUse) {
    ReusedVector<int> numbers{1, 2, 3};
    numbers.clear();
    numbers.push_back(4);
    ReusedVector<int> copy = numbers;
    EXPECT_EQ(copy.size(), 1u);
    EXPECT_EQ(copy[0], 4);
    const ReusedVector<int> moved = std::move(copy);
    EXPECT_EQ(moved.size(), 1u);
    EXPECT_TRUE(copy.empty());  // NOLINT(bugprone-use-after-move): it is empty, and may be filled anew
}

TEST(ReusedVectorDeathTest, AnElementThatIsNotInUseIsAFailedCheck) {
    ReusedVector<int> numbers{1, 2};
    numbers.clear();
    numbers.push_back(3);
    EXPECT_DEATH(numbers[1], "an index is below the size");
}

}  // namespace
}  // namespace lockstep
