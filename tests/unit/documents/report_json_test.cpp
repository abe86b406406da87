// Reports as JSON for other programs have the documented keys. Zeros are written, unknown values are left out.
#include "services/documents/report_json.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "idl/proto/report.pb.h"

namespace lockstep {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ReportJson, KeysAreThoseOfTheSchemaAndZerosAreWritten) {
    proto::PlanReport report;
    report.set_program("plate.gcode");
    report.add_axes()->set_steps(3'000'000'000);
    const std::string json = report_json(report);
    EXPECT_THAT(json, HasSubstr("\"duration_s\": 0"));
    EXPECT_THAT(json, HasSubstr("\"steps\": \"3000000000\""));
    EXPECT_EQ(json.back(), '\n');
}

TEST(ReportJson, WarningsAreAListAtTheEnd) {
    proto::PlanReport report;
    report.set_program("plate.gcode");
    EXPECT_EQ(report_json(report, {}), report_json(report));
    const std::string json = report_json(report, {"axis \"E\"", "b"});
    EXPECT_THAT(json, HasSubstr(",\n \"warnings\": [\n  \"axis \\\"E\\\"\",\n  \"b\"\n ]\n}\n"));
}

TEST(ReportJson, UnknownValuesAreLeftOutAndZerosAreNot) {
    proto::StatusReport report;
    EXPECT_THAT(report_json(report), Not(HasSubstr("progress")));
    EXPECT_THAT(report_json(report), Not(HasSubstr("fault")));
    report.set_progress(0);
    EXPECT_THAT(report_json(report), HasSubstr("\"progress\": 0"));
}

}  // namespace
}  // namespace lockstep
