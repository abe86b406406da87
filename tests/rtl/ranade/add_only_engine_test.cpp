// sim_fpga/rtl/ranade/add_only_engine.v beside the product's engine (core/step/engine.hpp), for one, three and six
// motors: every step of drawn pieces in the same tick, and pieces that follow each other without a gap.
#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <random>
#include <vector>

#include "Vadd_only_engine_1.h"
#include "Vadd_only_engine_3.h"
#include "Vadd_only_engine_6.h"
#include "core/step/engine.hpp"
#include "tests/property/step/random_segment.hpp"
#include "tests/rtl/clocked.hpp"

namespace lockstep::rtl {
namespace {

template <typename Module, int Motors, int MotorBits>
struct Width {
    using Engine = Module;
    static constexpr int kMotors = Motors;
    static constexpr int kMotorBits = MotorBits;
};

struct Word {
    std::uint32_t address;
    std::uint32_t data;
};

/// A piece that a motor has, and since when.
struct Held {
    Piece piece;
    int bank;
    std::int64_t marked;  // the tick in which it was marked full
};

struct Motor {
    std::deque<Held> held;
    int next_bank = 0;
    Position at;
    Tick end;  // of the last piece that has ended
    std::deque<StepEdge> made;
};

/// The engine, its motors and a host that gives them drawn pieces, one word after the other.
template <typename Engine, int Motors>
class Bench {
public:
    explicit Bench(std::uint64_t seed) : draw_(seed) {}

    void clock() {
        give();
        auto& pins = hardware_.pins;
        const auto before = pins.full;
        pins.eval();
        const bool written = pins.written != 0;
        hardware_.clock();
        if (written) { words_.pop_front(); }
        collect();
        for (int bit = 0; bit < 2 * Motors; ++bit) {
            if ((before >> bit & 1) != 0 && (pins.full >> bit & 1) == 0) { finish(bit / 2, bit % 2); }
        }
    }

    std::int64_t now() const { return now_; }
    std::int64_t steps() const { return steps_; }
    std::int64_t joined() const { return joined_; }

private:
    /// The host: writes words while there are any, then marks the bank, then chooses a motor with an empty bank.
    void give() {
        auto& pins = hardware_.pins;
        pins.mark = 0;
        if (words_.empty() && giving_) {
            pins.mark = 1;
            pins.mark_motor = static_cast<std::uint8_t>(receiver_);
            pins.mark_bank = bank_ != 0;
            motors_[at(receiver_)].held.push_back({piece_, bank_, now_});
            giving_ = false;
        } else if (words_.empty()) {
            choose();
        }
        pins.write = !words_.empty();
        if (words_.empty()) { return; }
        pins.write_address = static_cast<std::uint8_t>(words_.front().address);
        pins.write_data = words_.front().data;
    }

    void choose() {
        receiver_ = static_cast<int>(draw_.below(Motors));
        Motor& motor = motors_[at(receiver_)];
        if (motor.held.size() == 2 || draw_.one_in(100)) { return; }
        bank_ = motor.next_bank;
        motor.next_bank = 1 - bank_;
        giving_ = true;
        piece_ = draw_.next(7).piece;
        const auto base = static_cast<std::uint32_t>(receiver_ * 16 + bank_);
        const auto v = static_cast<std::uint64_t>(piece_.velocity.raw);
        const auto a = static_cast<std::uint64_t>(piece_.acceleration.raw);
        words_ = {{base + 0, static_cast<std::uint32_t>(piece_.ticks.value)},
                  {base + 2, static_cast<std::uint32_t>(v)},
                  {base + 4, static_cast<std::uint32_t>(v >> 32)},
                  {base + 8, static_cast<std::uint32_t>(a)},
                  {base + 10, static_cast<std::uint32_t>(a >> 32)}};
    }

    void collect() {
        auto& pins = hardware_.pins;
        if (pins.tick == 0) { return; }
        ++now_;
        for (int i = 0; i < Motors; ++i) {
            const int direction = (pins.forward >> i & 1) - (pins.backward >> i & 1);
            ASSERT_FALSE((pins.forward >> i & 1) != 0 && (pins.backward >> i & 1) != 0) << "two steps in a tick";
            if (direction != 0) { motors_[at(i)].made.push_back({Tick{now_}, static_cast<std::int8_t>(direction)}); }
            check(motors_[at(i)]);
        }
    }

    /// The bank became empty: its piece ends in the tick whose steps come next.
    void finish(int index, int bank) {
        Motor& motor = motors_[at(index)];
        ASSERT_FALSE(motor.held.empty());
        const Held held = motor.held.front();
        ASSERT_EQ(held.bank, bank);
        motor.held.pop_front();
        const Tick end{now_ + 1};
        const Segment segment{end - held.piece.ticks, motor.at, held.piece};
        ASSERT_GE(segment.start, motor.end) << "pieces overlap";
        if (held.marked < motor.end.value - 1) {
            ASSERT_EQ(segment.start, motor.end) << "a gap between pieces";
            ++joined_;
        }
        for_each_step(segment, [&](StepEdge edge) { expected_[at(index)].push_back(edge); });
        motor.at = segment.to();
        motor.end = end;
    }

    /// Compares the steps of all ended pieces.
    void check(Motor& motor) {
        auto& expected = expected_[static_cast<std::size_t>(&motor - motors_.data())];
        while (!expected.empty()) {
            if (motor.end.value > now_) { return; }
            ASSERT_FALSE(motor.made.empty()) << "a step is missing in tick " << expected.front().tick.value;
            ASSERT_EQ(motor.made.front().tick.value, expected.front().tick.value);
            ASSERT_EQ(motor.made.front().direction, expected.front().direction);
            motor.made.pop_front();
            expected.pop_front();
            ++steps_;
        }
        if (motor.held.empty() && motor.end.value <= now_) { ASSERT_TRUE(motor.made.empty()) << "a step at rest"; }
    }

    static std::size_t at(int motor) { return static_cast<std::size_t>(motor); }

    Clocked<Engine> hardware_;
    testing::RandomSegments draw_;
    std::array<Motor, Motors> motors_;
    std::array<std::deque<StepEdge>, Motors> expected_;
    std::deque<Word> words_;
    bool giving_ = false;
    int receiver_ = 0;
    int bank_ = 0;
    Piece piece_{};
    std::int64_t now_ = 0;
    std::int64_t steps_ = 0;
    std::int64_t joined_ = 0;
};

template <typename T>
class EngineHardware : public ::testing::Test {};
using Widths =
    ::testing::Types<Width<Vadd_only_engine_1, 1, 1>, Width<Vadd_only_engine_3, 3, 2>, Width<Vadd_only_engine_6, 6, 3>>;
TYPED_TEST_SUITE(EngineHardware, Widths);

TYPED_TEST(EngineHardware, MakesEveryStepOfDrawnPiecesInTheTickOfTheProductsEngine) {
    Bench<typename TypeParam::Engine, TypeParam::kMotors> bench(3);
    while (bench.now() < 200'000 && !this->HasFailure()) { bench.clock(); }
    EXPECT_GT(bench.steps(), 4'000 * TypeParam::kMotors);
    EXPECT_GT(bench.joined(), 200 * TypeParam::kMotors);
}

}  // namespace
}  // namespace lockstep::rtl
