#include "clients/analysis/csv.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "tests/unit/analysis/file_text.hpp"
#include "tests/unit/analysis/step_makers.hpp"

namespace lockstep::analysis {
namespace {

using test::text_of;

TEST(StepCsv, HasALineForEachStepWithThePositionAfterIt) {
    const auto path = std::filesystem::path(testing::TempDir()) / "steps_X.csv";
    auto file = CsvFile::create(path, StepCsv::kHeader);
    ASSERT_TRUE(file);
    StepCsv csv(std::move(*file));
    csv.on_batch(test::batch(1, -1, test::even_steps(100, 10, 3)));
    csv.on_batch(test::batch(2, 2, test::even_steps(9'000'000'000, 10, 1, -1)));
    ASSERT_TRUE(csv.close());
    EXPECT_EQ(text_of(path), "tick,position\n100,0\n110,1\n120,2\n9000000000,1\n");
}

TEST(CsvFile, ReportsTheFileThatCannotBeWritten) {
    const auto file = CsvFile::create("/nowhere/at/all.csv", "a");
    ASSERT_FALSE(file);
    EXPECT_EQ(file.error(), "/nowhere/at/all.csv: cannot be written: No such file or directory");
}

}  // namespace
}  // namespace lockstep::analysis
