// How much of the processor's time the execution of ticks takes: the table of the firmware's README.
//
// LOCKSTEP_WRITE_BOARD_TABLE=1 build/bin/simulation_board --gtest_filter=BoardLoad.* writes it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>

#include "tests/simulation/board/board_fixture.hpp"

namespace lockstep::testing {
namespace {

constexpr const char* kReadme = "sim_fpga/firmware/README.md";
constexpr const char* kTableHead = "| motors that move |";

/// Forward at a constant speed, in one piece.
Course steady(Tick start, std::int64_t ticks_per_step) {
    constexpr Ticks kWay{20'000};
    const Piece piece{kWay, {std::numeric_limits<std::int64_t>::max() / ticks_per_step * 2}, {}};
    return {{{1, start, true, {rest_position(0, false), {piece}, {}}}}, 1, {}, start + kWay};
}

/// A board that has just been switched on.
class LoadedBoard : public Board {
public:
    LoadedBoard() { connect(HostLine::Uart); }
    void TestBody() override {}

    /// The share of the processor's time while the first so many motors move and the others rest, in percent.
    double load(std::size_t moving, std::int64_t ticks_per_step) {
        const Tick start = soon();
        for (std::size_t motor = 0; motor < moving; ++motor) { order(motor, steady(start, ticks_per_step)); }
        run(start.value + 5'000);
        const double begun = bench.interrupted();
        const std::uint32_t from = bench.now_us();
        run(start.value + 17'000);
        return 100 * (bench.interrupted() - begun) / ((bench.now_us() - from) * kCyclesPerTick);
    }
};

/// What the table states: the rest of each of its lines behind the head.
std::vector<std::vector<double>> stated(const std::string& readme) {
    std::vector<std::vector<double>> rows;
    std::istringstream lines(readme.substr(std::min(readme.find(kTableHead), readme.size())));
    for (std::string line; std::getline(lines, line) && line.starts_with("|");) {
        std::istringstream numbers(line);
        std::vector<double>& row = rows.emplace_back();
        for (std::string word; numbers >> word;) {
            if (std::isdigit(static_cast<unsigned char>(word.front())) != 0) { row.push_back(std::stod(word)); }
        }
    }
    rows.erase(rows.begin(), rows.begin() + std::min<std::ptrdiff_t>(2, std::ssize(rows)));
    return rows;
}

void replace_table(std::string readme, const std::string& table) {
    const std::size_t begin = readme.find(kTableHead);
    const std::size_t end = readme.find("\n\n", begin) + 1;
    std::ofstream(kReadme) << readme.replace(begin, end - begin, table);
}

/// A compiler of another version may need a little more or less.
TEST(BoardLoad, IsAsTheReadmeStates) {
    constexpr double kTolerance = 3;
    std::ifstream file(kReadme);
    const std::string readme{std::istreambuf_iterator<char>(file), {}};
    const auto rows = stated(readme);
    std::string table = std::string(kTableHead) + " at 62,500 steps/s each | at 31,250 steps/s each |\n|---|---|---|\n";
    for (std::size_t moving = 0; moving <= kMotors; ++moving) {
        const std::array loads{LoadedBoard().load(moving, 16), LoadedBoard().load(moving, 32)};
        table += fmt::format("| {} | {:.0f} % | {:.0f} % |\n", moving, loads[0], loads[1]);
        if (std::getenv("LOCKSTEP_WRITE_BOARD_TABLE") != nullptr) { continue; }
        ASSERT_GT(rows.size(), moving) << "the table has too few rows";
        ASSERT_EQ(rows[moving].size(), 3U);
        EXPECT_NEAR(rows[moving][1], loads[0], kTolerance);
        EXPECT_NEAR(rows[moving][2], loads[1], kTolerance);
    }
    if (std::getenv("LOCKSTEP_WRITE_BOARD_TABLE") != nullptr) { replace_table(readme, table); }
}

}  // namespace
}  // namespace lockstep::testing
