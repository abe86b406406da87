// The reason why a request is refused, as JSON.
#include "clients/web/request/problem.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

TEST(Problem, ARefusalOfTheMachineHasItsCauseAndRemedy) {
    const Json json = problem_json(refused(FaultCode::NotHomed, "axis X is not homed"));
    EXPECT_EQ(json["status"], 409);
    EXPECT_EQ(json["code"], "not-homed");
    EXPECT_EQ(json["detail"], "axis X is not homed");
    EXPECT_EQ(json["number"], static_cast<int>(FaultCode::NotHomed));
    EXPECT_FALSE(json["remedy"].get<std::string>().empty());
}

TEST(Problem, ARefusalWithoutATextTakesTheTables) {
    const Json json = problem_json(refused(FaultCode::Held, ""));
    EXPECT_EQ(json["detail"], json["title"]);
    EXPECT_EQ(refused(static_cast<FaultCode>(65535), "why").title, "the machine refuses the command");
}

TEST(Problem, AnotherWriterIsTakenOverByARequestAndNotByAnOption) {
    const Problem problem = refused(FaultCode::WriterHeld, "anna on bench has been the machine's writer for 3 s");
    EXPECT_EQ(problem.status, 409);
    EXPECT_EQ(problem.code, "writer-held");
    EXPECT_NE(problem.remedy.find("{take}"), std::string::npos);
    EXPECT_EQ(problem.remedy.find("--take"), std::string::npos);
}

TEST(Problem, LeavesOutWhatItDoesNotHave) {
    const Json json = problem_json({.status = 400, .code = "c", .title = "t", .detail = "d"});
    EXPECT_EQ(json, (Json{{"type", "about:blank"}, {"title", "t"}, {"status", 400}, {"code", "c"}, {"detail", "d"}}));
}

TEST(Problem, NamesTheFirstErrorsOfAProgram) {
    Problem problem{.status = 422, .errors = {}};
    for (int line = 1; line <= 100; ++line) { problem.errors.push_back({.line = line, .column = 2, .message = "m"}); }
    const Json json = problem_json(problem);
    ASSERT_EQ(json["errors"].size(), 20u);
    EXPECT_EQ(json["errors"][0], (Json{{"line", 1}, {"column", 2}, {"message", "m"}}));
}

TEST(Problem, BytesThatAreNoTextDoNotBreakTheAnswer) {
    const Response response = to_response({.status = 400, .code = "c", .detail = "\xff\xfe\x80"});
    EXPECT_TRUE(Json::accept(std::get<std::string>(response.body)));
    EXPECT_EQ(response.headers.front().second, "application/problem+json");
}

}  // namespace
}  // namespace lockstep::web
