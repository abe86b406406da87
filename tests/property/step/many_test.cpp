// Many axes at once make the same steps as each axis alone.
#include <gtest/gtest.h>
#include <hwy/highway.h>

#include <algorithm>
#include <string>
#include <vector>

#include "core/step/tick_engine.hpp"
#include "tests/benchmarks/step/many/run_many.hpp"
#include "tests/property/step/print_segment.hpp"
#include "tests/property/step/random_segment.hpp"

namespace lockstep {
namespace {

using testing::RandomSegments;
using Steps = std::vector<StepEdge>;

Steps steps_of(const EdgeBuffer& edges) {
    Steps steps;
    for (std::size_t i = 0; i < edges.size(); ++i) { steps.push_back(edges[i]); }
    return steps;
}

Steps ticked(const Segment& segment) {
    Steps steps;
    tick_by_tick(segment, [&](StepEdge edge) { steps.push_back(edge); });
    return steps;
}

/// Every instruction set of this processor for which the vector form was compiled.
class ManyAxesOn : public ::testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { use(GetParam()); }
    void TearDown() override { use(0); }

private:
    static void use(std::int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

TEST_P(ManyAxesOn, RandomSegmentsAreTheSameTickByTickAndInVectors) {
    constexpr std::size_t kAxes = 32;
    RandomSegments segments(7);
    std::vector<std::vector<std::int64_t>> rooms(kAxes, std::vector<std::int64_t>(1 << 17));
    std::vector<Segment> given(kAxes);
    std::vector<StepEngine> axes(kAxes);
    for (int round = 0; round < 200'000 / 32; ++round) {
        std::vector<EdgeBuffer> edges(rooms.begin(), rooms.end());
        Tick end;
        for (std::size_t i = 0; i < kAxes; ++i) {
            given[i] = segments.next(round % 50 == 0 ? 15 : 12);
            axes[i] = StepEngine(given[i].start, given[i].from);
            axes[i].begin(given[i].piece);
            end = std::max(end, given[i].end());
        }
        run_many(axes, given[0].start + Ticks{segments.below(1000)}, edges);
        run_many(axes, end, edges);
        for (std::size_t i = 0; i < kAxes; ++i) {
            ASSERT_EQ(steps_of(edges[i]), ticked(given[i])) << given[i];
            ASSERT_EQ(axes[i].position(), given[i].to());
            ASSERT_TRUE(axes[i].idle());
        }
    }
}

std::vector<std::int64_t> instruction_sets() {
    std::vector<std::int64_t> sets;
    for (std::int64_t left = hwy::SupportedTargets() & HWY_TARGETS; left != 0; left &= left - 1) {
        sets.push_back(left & -left);
    }
    return sets;
}

INSTANTIATE_TEST_SUITE_P(Every, ManyAxesOn, ::testing::ValuesIn(instruction_sets()),
                         [](const auto& set) { return std::string(hwy::TargetName(set.param)); });

TEST(ManyAxes, AnAxisStopsWhereItsBufferHasNoRoomForAStretch) {
    RandomSegments segments(8);
    std::vector<std::int64_t> room(200, -1);
    for (int i = 0; i < 100'000; ++i) {
        const Segment segment = segments.next(12);
        StepEngine axis(segment.start, segment.from);
        axis.begin(segment.piece);
        std::ranges::fill(room, -1);
        const auto fits = static_cast<std::size_t>(segments.below(100)) + EdgeBuffer::kSlack;
        EdgeBuffer edges{std::span(room).first(fits)};
        run_into(axis, segment.end(), edges);
        Steps steps = steps_of(edges);
        axis.run(segment.end(), [&](StepEdge edge) { steps.push_back(edge); });  // goes on where it stopped
        ASSERT_EQ(steps, ticked(segment)) << segment;
        ASSERT_EQ(room[fits], -1) << "wrote beyond its room";
    }
}

}  // namespace
}  // namespace lockstep
