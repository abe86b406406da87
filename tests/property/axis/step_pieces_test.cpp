// Pieces made for given ticks make each step at exactly this tick, forward and backward.
#include "core/axis/own_moves/step_pieces.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <vector>

#include "core/methods/paper_steps.hpp"
#include "core/step/engine.hpp"

namespace lockstep {
namespace {

std::vector<Piece> pieces_for(const std::vector<double>& steps, std::size_t cut_every = SIZE_MAX) {
    StepPieces maker;
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < steps.size(); ++i) {
        if (const auto before = maker.add(steps[i])) { pieces.push_back(*before); }
        if ((i + 1) % cut_every == 0) { pieces.push_back(*maker.cut()); }
    }
    if (const auto rest = maker.cut()) { pieces.push_back(*rest); }
    pieces.push_back(maker.last_half());
    return pieces;
}

/// The steps that the engine makes from the pieces, starting at rest on a whole step.
std::vector<Ticks> steps_of(const std::vector<Piece>& pieces, bool backward, Position& end) {
    StepEngine engine(Tick{0}, rest_position(7, backward));
    std::vector<Ticks> steps;
    for (Piece piece : pieces) {
        if (backward) { piece.velocity.raw = -piece.velocity.raw; }
        engine.begin(piece);
        engine.run(engine.now() + piece.ticks, [&](StepEdge edge) {
            EXPECT_EQ(edge.direction, backward ? -1 : 1);
            steps.push_back(edge.tick - Tick{0});
        });
    }
    end = engine.position();
    return steps;
}

void expect_exact(const std::vector<double>& steps, std::size_t cut_every = SIZE_MAX) {
    const std::vector<Piece> pieces = pieces_for(steps, cut_every);
    const auto count = static_cast<std::int64_t>(steps.size());
    std::vector<Ticks> nearest;
    for (const double ticks : steps) { nearest.push_back({std::llround(ticks)}); }
    for (const bool backward : {false, true}) {
        Position end;
        ASSERT_EQ(steps_of(pieces, backward, end), nearest);
        EXPECT_EQ(end.count(), 7 + (backward ? -count : count));
        EXPECT_NEAR(end.as_steps(), static_cast<double>(end.count()), 1e-9) << "at rest on a whole step";
    }
}

TEST(StepPieces, AnyTicksAreMet) {
    std::mt19937_64 random(11);
    for (int run = 0; run < 3000; ++run) {
        const int digits = static_cast<int>(random() % 20) + 1;
        std::vector<double> steps;
        double at = 0;
        for (std::size_t left = 1 + random() % 60; left > 0; --left) {
            at += 3 + static_cast<double>(random() % (std::uint64_t{1} << digits));
            steps.push_back(at);
        }
        expect_exact(steps, 1 + random() % 20);
        expect_exact(steps);
    }
}

TEST(StepPieces, OneSpeedRoundedToTicksIsAFewPieces) {
    for (const double interval : {100.0, 100.8, 17.123, 3.2, 98765.4321}) {
        std::vector<double> steps;
        for (int k = 1; k <= 5000; ++k) { steps.push_back(interval * k); }
        expect_exact(steps);
        EXPECT_LE(pieces_for(steps).size(), 25u) << interval;
    }
}

TEST(StepPieces, EveryMethodsTrainIsMet) {
    for (const StepMethod method : {StepMethod::Spielauer, StepMethod::Lai, StepMethod::Lam, StepMethod::Carrica}) {
        for (const std::int64_t count : {1, 2, 7, 100, 20'000}) {
            auto source = methods::begin_steps(method, {count, 500, 8'000, 30'000, 30'000});
            ASSERT_TRUE(source.has_value()) << text_of(source.error());
            std::vector<double> steps;
            for (std::int64_t k = 0; k < count; ++k) { steps.push_back((*source)->next_s() * 1e6); }
            expect_exact(steps);
        }
    }
}

}  // namespace
}  // namespace lockstep
