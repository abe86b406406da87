// States in shared memory: complete and in order, even if a process is killed, late or hostile.
#include "services/wire/shared/state_board.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <fstream>
#include <thread>
#include <vector>

#include "tests/temporary_directory.hpp"
#include "tests/unit/wire/random_messages.hpp"

namespace lockstep {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr std::size_t kPartStride_bytes = 65536 + 64;  // from the part of one axis to the next in the file
constexpr std::size_t kFirstSlotByte = 64;

class StateBoard : public testing::Test {
protected:
    StateBoardWriter writer(std::uint32_t axis) const { return StateBoardWriter::open(path, axis).value(); }
    StateBoardReader reader(std::optional<std::uint32_t> own = {}) const {
        return StateBoardReader::open(path, own).value();
    }
    void overwrite(std::size_t at, const std::string& bytes) const {
        std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
        file.seekp(static_cast<std::streamoff>(at));
        file << bytes;
    }

    TemporaryDirectory directory;
    fs::path path = directory.path() / "states" / "mill.states";
};

AxisState state_of(std::uint32_t axis, Slot stamp) { return {.axis = axis, .stamp = stamp}; }

std::vector<AxisState> read_from(StateBoardReader& reader) {
    std::vector<AxisState> states;
    reader.take([&](AxisState&& state) { states.push_back(state); });
    return states;
}

TEST_F(StateBoard, AllReadTheStatesOfTheOthersInOrder) {
    RandomMessages random(5);
    StateBoardWriter first = writer(0);
    StateBoardWriter last = writer(kMaxAxes - 1);
    StateBoardReader of_first = reader(0);
    StateBoardReader of_coordinator = reader();
    std::vector<AxisState> states;
    for (int i = 0; i < 3; ++i) {
        for (auto [axis, to] : {std::pair{std::uint32_t{0}, &first}, {kMaxAxes - 1, &last}}) {
            states.push_back(random.axis_state());
            states.back().axis = axis;
            to->write(states.back());
        }
    }
    EXPECT_THAT(read_from(of_coordinator),
                ElementsAre(states[0], states[2], states[4], states[1], states[3], states[5]));
    EXPECT_THAT(read_from(of_first), ElementsAre(states[1], states[3], states[5])) << "not its own";
    EXPECT_THAT(read_from(of_coordinator), IsEmpty()) << "each once";
}

TEST_F(StateBoard, IgnoresStatesWrittenBeforeTheReaderOpened) {
    StateBoardWriter axis = writer(1);
    axis.write(state_of(1, 1));
    StateBoardReader late = reader();
    EXPECT_THAT(read_from(late), IsEmpty());
    axis.write(state_of(1, 2));
    EXPECT_THAT(read_from(late), ElementsAre(state_of(1, 2)));
}

TEST_F(StateBoard, AStalledReaderGetsTheNewest) {
    StateBoardWriter axis = writer(1);
    StateBoardReader stalled = reader();
    constexpr Slot kWritten = 2 * kStatesKept + 17;
    for (Slot stamp = 1; stamp <= kWritten; ++stamp) { axis.write(state_of(1, stamp)); }
    const std::vector<AxisState> states = read_from(stalled);
    ASSERT_EQ(states.size(), kStatesKept);
    for (std::size_t i = 0; i < states.size(); ++i) {
        EXPECT_EQ(states[i].stamp, kWritten - static_cast<Slot>(kStatesKept - 1 - i));
    }
}

TEST_F(StateBoard, IsReadWholeAndInOrderDuringWrites) {
    StateBoardWriter axis = writer(2);
    StateBoardReader listener = reader();
    std::jthread writer_thread([&](const std::stop_token& stop) {
        for (Slot i = 1; !stop.stop_requested(); ++i) {
            axis.write({.identity = static_cast<Identity>(i),
                        .axis = 2,
                        .stamp = i,
                        .following_error_steps = i,
                        .refused_frames = static_cast<std::uint64_t>(i)});
        }
    });
    Slot latest = 0;
    for (std::size_t taken = 0; taken < 20'000;) {
        taken += listener.take([&](AxisState&& state) {
            EXPECT_GT(state.stamp, latest);
            latest = state.stamp;
            EXPECT_EQ(state.identity, static_cast<Identity>(latest));
            EXPECT_EQ(state.following_error_steps, latest);
            EXPECT_EQ(state.refused_frames, static_cast<std::uint64_t>(latest));
        });
    }
    EXPECT_EQ(listener.refusals().count, 0U);
}

TEST_F(StateBoard, AnAxisHasOneProcess) {
    {
        const StateBoardWriter first = writer(3);
        const auto second = StateBoardWriter::open(path, 3);
        ASSERT_FALSE(second);
        EXPECT_THAT(second.error(), HasSubstr("axis 3 is already run by another process"));
        EXPECT_TRUE(StateBoardWriter::open(path, 4)) << "another axis may";
    }
    EXPECT_TRUE(StateBoardWriter::open(path, 3));
}

TEST_F(StateBoard, AKilledProcessLeavesItsPartToTheNext) {
    StateBoardReader listener = reader();
    const pid_t child = fork();
    if (child == 0) {
        StateBoardWriter axis = writer(1);
        axis.write(state_of(1, 41));
        raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    EXPECT_THAT(read_from(listener), ElementsAre(state_of(1, 41)));
    writer(1).write(state_of(1, 42));
    EXPECT_THAT(read_from(listener), ElementsAre(state_of(1, 42)));
}

TEST_F(StateBoard, IgnoresHalfWrittenState) {
    StateBoardWriter axis = writer(0);
    StateBoardReader listener = reader();
    for (const Slot stamp : {1, 2, 3}) { axis.write(state_of(0, stamp)); }
    const std::size_t slot_bytes = NumberedSlot<lockstep_wire_AxisState>::kWords * sizeof(std::uint64_t);
    overwrite(kFirstSlotByte + 2 * slot_bytes, std::string(8, '\0'));  // overwrites its number
    EXPECT_THAT(read_from(listener), ElementsAre(state_of(0, 1), state_of(0, 3)));
}

TEST_F(StateBoard, AnotherVersionIsRefusedUntilItsAxisRestarts) {
    StateBoardReader listener = reader();
    {
        StateBoardWriter axis = writer(0);
        overwrite(0, "another!");
        axis.write(state_of(0, 1));
        EXPECT_THAT(read_from(listener), IsEmpty());
        EXPECT_EQ(listener.refusals().count, 1U);
        EXPECT_THAT(listener.refusals().last, HasSubstr("another version"));
    }
    StateBoardWriter restarted = writer(0);
    (void)read_from(listener);
    restarted.write(state_of(0, 2));
    EXPECT_THAT(read_from(listener), ElementsAre(state_of(0, 2)));
}

TEST_F(StateBoard, RefusesStatesOfAnotherAxis) {
    StateBoardWriter axis = writer(0);
    StateBoardReader listener = reader();
    axis.write(state_of(1, 1));
    EXPECT_THAT(read_from(listener), IsEmpty());
    EXPECT_THAT(listener.refusals().last, HasSubstr("the part of axis 0 does not contain a state of that axis"));
}

TEST_F(StateBoard, DamagedIsRefusedOrHarmless) {
    StateBoardWriter axis = writer(1);
    StateBoardReader listener = reader();
    RandomMessages random(6);
    for (int i = 0; i < 2000; ++i) {
        for (int n = 0; n < 3; ++n) { axis.write(random.axis_state()); }
        const auto at = static_cast<std::size_t>(random.between(8, 3000));  // may be the count of states too
        overwrite(kPartStride_bytes + at, std::string(1, static_cast<char>(random.bits())));
        (void)read_from(listener);
    }
    EXPECT_GT(listener.refusals().count, 0U);
    (void)read_from(listener);
    axis.write(state_of(1, 7));
    EXPECT_THAT(read_from(listener), ElementsAre(state_of(1, 7))) << "later states are read again";
}

TEST_F(StateBoard, ReportsThatItWasRemovedOrOverwrittenUntilItIsOpenedAgain) {
    {
        const StateBoardWriter axis = writer(1);
        const StateBoardReader listener = reader();
        EXPECT_TRUE(axis.is_current() && listener.is_current());
        overwrite(kPartStride_bytes, "garbage!");
        EXPECT_FALSE(axis.is_current()) << "only it may initialize its part again";
        EXPECT_TRUE(listener.is_current());
        EXPECT_TRUE(StateBoardReader::open(path, {})->is_current());
    }
    StateBoardWriter axis = writer(1);
    StateBoardReader listener = reader();
    fs::remove(path);
    EXPECT_FALSE(axis.is_current());
    EXPECT_FALSE(listener.is_current());
}

TEST_F(StateBoard, GoesWithItsLastProcess) {
    {
        const StateBoardReader listener = reader();
        { const StateBoardWriter axis = writer(0); }
        EXPECT_TRUE(fs::exists(path));
    }
    EXPECT_FALSE(fs::exists(path));
}

TEST_F(StateBoard, IsForThisUserAlone) {
    const StateBoardReader listener = reader();
    EXPECT_EQ(fs::status(path).permissions(), fs::perms::owner_read | fs::perms::owner_write);
    fs::create_symlink(path, path.parent_path() / "other");
    EXPECT_FALSE(StateBoardReader::open(path.parent_path() / "other", {})) << "another user may have put it there";
}

}  // namespace
}  // namespace lockstep
