// A queue that keeps its elements' memory when they are removed.
#include "core/reused_queue.hpp"

#include <gtest/gtest.h>

#include <string>

namespace lockstep {
namespace {

std::string content(const ReusedQueue<int>& queue) {
    std::string text;
    for (std::size_t i = 0; i < queue.size(); ++i) { text += std::to_string(queue[i]) + ' '; }
    return text;
}

TEST(ReusedQueue, GivesElementsInTheOrderInWhichTheyWereAdded) {
    ReusedQueue<int> queue;
    for (const int value : {1, 2, 3}) { queue.push_back(value); }
    queue.pop_front();
    queue.push_back(4);
    queue.push_back(5);  // the ring grows in its middle
    EXPECT_EQ(content(queue), "2 3 4 5 ");
    queue.pop_back();
    EXPECT_EQ(queue.front(), 2);
    EXPECT_EQ(queue.back(), 4);
}

TEST(ReusedQueue, KeepsTheMemoryOfRemovedElements) {
    ReusedQueue<std::string> texts;
    texts.push_back(std::string(100, 'a'));
    const char* const memory = texts.front().data();
    texts.pop_front();
    texts.push_back("short");
    EXPECT_EQ(texts.front(), "short");
    EXPECT_EQ(texts.front().data(), memory);
}

TEST(ReusedQueue, AnElementThatIsMadeAgainTakesMemoryAndNoOldValue) {
    struct Note {
        int number = 0;
        std::string text;
    };
    ReusedQueue<Note> notes;
    notes.push_back({7, std::string(100, 'a')});
    const char* const memory = notes.back().text.data();
    notes.pop_back();
    const Note& note = notes.renew_back([](Note&& old) {
        old.text.clear();
        return Note{.text = std::move(old.text)};
    });
    EXPECT_EQ(note.number, 0) << "a field that is not named has its default";
    EXPECT_EQ(note.text.data(), memory);
}

TEST(ReusedQueue, AnElementThatIsMadeInItsPlaceHasNoOldValue) {
    struct Pair {
        int first = 1;
        int second = 2;
    };
    ReusedQueue<Pair> pairs;
    pairs.push_back({7, 8});
    pairs.pop_back();
    const Pair& pair = pairs.make_back([] { return Pair{.first = 3}; });
    EXPECT_EQ(pair.first, 3);
    EXPECT_EQ(pair.second, 2) << "a field that is not named has its default";
    EXPECT_EQ(pairs.size(), 1u);
}

TEST(ReusedQueue, AnElementKeepsItsAddressWhileOthersAreAddedAndRemoved) {
    ReusedQueue<int> queue;
    queue.push_back(1);
    queue.push_back(2);
    const int* const second = &queue.back();
    queue.pop_front();
    for (int value = 3; value < 20; ++value) { queue.push_back(value); }
    EXPECT_EQ(&queue.front(), second);
}

TEST(ReusedQueue, CopiesAndMovesOnlyWhatIsInUse) {
    ReusedQueue<int> queue;
    for (const int value : {1, 2, 3}) { queue.push_back(value); }
    queue.pop_front();
    ReusedQueue<int> copy = queue;
    EXPECT_EQ(content(copy), "2 3 ");
    const ReusedQueue<int> moved = std::move(copy);
    EXPECT_EQ(content(moved), "2 3 ");
    EXPECT_TRUE(copy.empty());  // NOLINT(bugprone-use-after-move): a queue that was moved from is empty
}

TEST(ReusedQueueDeathTest, ElementsThatAreNotThereAreFailedChecks) {
    ReusedQueue<int> queue;
    queue.push_back(1);
    queue.pop_front();
    EXPECT_DEATH(queue[0], "an index is below the size");
    EXPECT_DEATH(queue.front(), "an index is below the size");
    EXPECT_DEATH(queue.back(), "an index is below the size");
    EXPECT_DEATH(queue.pop_front(), "an element that is removed is there");
    EXPECT_DEATH(queue.pop_back(), "an element that is removed is there");
}

}  // namespace
}  // namespace lockstep
