// Members of a JSON object from outside.
#include "clients/web/request/body_reader.hpp"

#include <gtest/gtest.h>

namespace lockstep::web {
namespace {

std::string refusal(std::string_view text) {
    const auto object = read_object(text);
    return object ? "" : object.error().code;
}

class Body : public testing::Test {
protected:
    /// The status, code and place of the refusal of `read`.
    template <typename Read>
    std::string refused(const Json& object, const Read& read) {
        std::optional<Problem> problem;
        BodyReader reader(object, "/at", problem);
        read(reader);
        return problem ? std::to_string(problem->status) + " " + problem->code + " " + problem->place : "";
    }
};

TEST(ReadObject, AnEmptyTextIsAnEmptyObject) {
    EXPECT_EQ(read_object("").value(), Json::object());
    EXPECT_EQ(read_object(" {} ").value(), Json::object());
}

TEST(ReadObject, RefusesWhatIsNoObject) {
    for (const char* text : {"{", "}", "[]", "1", "null", "\"a\"", "{\"a\":}", "{\"a\":1,}", "{\"a\":NaN}", "{} {}",
                             "{'a':1}", "{\"a\":1e999}", "{\"a\":\"\xff\"}", "\xef\xbb", "// a\n{}"}) {
        EXPECT_EQ(refusal(text), "bad-json") << text;
    }
    EXPECT_EQ(refusal(std::string_view("\0{}", 3)), "bad-json");
}

TEST(ReadObject, RefusesAMemberThatIsGivenTwice) {
    EXPECT_EQ(refusal(R"({"a":1,"a":2})"), "bad-json");
    EXPECT_EQ(refusal(R"({"a":{"b":1,"b":1}})"), "bad-json");
    EXPECT_EQ(refusal(R"({"a":{"b":1},"b":{"b":1}})"), "");
}

TEST(ReadObject, RefusesDeepNestingBeforeItIsParsed) {
    EXPECT_EQ(refusal(std::string(100'000, '[')), "bad-json");
    std::string deep = "{\"a\":";
    for (int i = 0; i < 100'000; ++i) { deep += "{\"a\":"; }
    EXPECT_EQ(refusal(deep), "bad-json");
    EXPECT_EQ(refusal(R"({"a":"[[[[[[[[[[[[[[\"[[[["})"), "") << "brackets in a text nest nothing";
    EXPECT_EQ(refusal(R"({"a":[[[[[[[]]]]]]]})"), "");
    EXPECT_EQ(refusal(R"({"a":[[[[[[[[]]]]]]]]})"), "bad-json");
}

TEST(BodyType, MustBeJsonWhereThereIsABody) {
    const auto refusal_of = [](const char* type) {
        const auto problem = refuse_other_type({.headers = {{"content-type", type}}, .body = "{}"});
        return problem ? problem->status : 0;
    };
    EXPECT_EQ(refusal_of("application/json"), 0);
    EXPECT_EQ(refusal_of("application/json; charset=utf-8"), 0);
    EXPECT_EQ(refusal_of("text/plain"), 415);
    EXPECT_EQ(refusal_of(""), 415);
    EXPECT_EQ(refuse_other_type({.body = "{}"})->status, 415);
    EXPECT_FALSE(refuse_other_type({.body = ""}));
}

TEST_F(Body, ReadsWhatIsThere) {
    const Json object{{"n", 1.5}, {"i", 7}, {"t", "text"}, {"f", true}, {"l", {1, 2}}, {"o", Json::object()}};
    EXPECT_EQ(refused(object,
                      [](BodyReader& reader) {
                          EXPECT_EQ(reader.number("n", 0, 2), 1.5);
                          EXPECT_EQ(reader.integer("i", 0, 7), 7);
                          EXPECT_EQ(reader.text("t", 4), "text");
                          EXPECT_EQ(reader.flag("f"), true);
                          EXPECT_EQ(reader.list("l", 2)->size(), 2u);
                          EXPECT_NE(reader.object("o"), nullptr);
                          EXPECT_EQ(reader.number("absent", 0, 1), std::nullopt);
                          reader.finish();
                      }),
              "");
}

TEST_F(Body, AnotherKindIsABadValueWithItsPlace) {
    const auto wrong = [&](const Json& value, const auto& read) { return refused({{"a", value}}, read); };
    EXPECT_EQ(wrong("1", [](BodyReader& r) { (void)r.number("a", 0, 2); }), "400 bad-value /at/a");
    EXPECT_EQ(wrong(true, [](BodyReader& r) { (void)r.number("a", 0, 2); }), "400 bad-value /at/a");
    EXPECT_EQ(wrong(nullptr, [](BodyReader& r) { (void)r.number("a", 0, 2); }), "400 bad-value /at/a");
    EXPECT_EQ(wrong(1.5, [](BodyReader& r) { (void)r.integer("a", 0, 2); }), "400 bad-value /at/a");
    EXPECT_EQ(wrong(1, [](BodyReader& r) { (void)r.text("a", 2); }), "400 bad-value /at/a");
    EXPECT_EQ(wrong(1, [](BodyReader& r) { (void)r.flag("a"); }), "400 bad-value /at/a");
    EXPECT_EQ(wrong(Json::object(), [](BodyReader& r) { (void)r.list("a", 2); }), "400 bad-value /at/a");
    EXPECT_EQ(wrong(Json::array(), [](BodyReader& r) { (void)r.object("a"); }), "400 bad-value /at/a");
}

TEST_F(Body, AValueBeyondItsRangeIsOutOfRange) {
    const auto wrong = [&](const Json& value, const auto& read) { return refused({{"a", value}}, read); };
    EXPECT_EQ(wrong(2.1, [](BodyReader& r) { (void)r.number("a", 0, 2); }), "422 out-of-range /at/a");
    EXPECT_EQ(wrong(-1, [](BodyReader& r) { (void)r.integer("a", 0, 2); }), "422 out-of-range /at/a");
    EXPECT_EQ(wrong(18446744073709551615U, [](BodyReader& r) { (void)r.integer("a", 0, 2); }),
              "422 out-of-range /at/a");
    EXPECT_EQ(wrong("abc", [](BodyReader& r) { (void)r.text("a", 2); }), "422 out-of-range /at/a");
    EXPECT_EQ(wrong({1, 2, 3}, [](BodyReader& r) { (void)r.list("a", 2); }), "422 out-of-range /at/a");
}

TEST_F(Body, ReportsWhatIsMissingOrUnknown) {
    EXPECT_EQ(refused(Json::object(), [](BodyReader& r) { r.require("a"); }), "400 missing-value /at/a");
    EXPECT_EQ(refused({{"a", 1}, {"b", 1}},
                      [](BodyReader& r) {
                          (void)r.number("a", 0, 1);
                          r.finish();
                      }),
              "400 unknown-member /at/b");
}

TEST_F(Body, KeepsTheFirstProblem) {
    EXPECT_EQ(refused({{"a", "x"}, {"b", 1}},
                      [](BodyReader& r) {
                          (void)r.number("a", 0, 1);
                          r.finish();
                      }),
              "400 bad-value /at/a");
}

TEST_F(Body, ARefusalIsShortHoweverLongTheRequestIs) {
    const std::string name(10'000, 'x');
    const auto size_of = [](const Problem& problem) { return dumped(problem_json(problem)).size(); };
    EXPECT_LT(size_of(wrong_value(422, "/a", name, "short")), 1000u);
    EXPECT_LT(refused({{name, 1}}, [](BodyReader& reader) { reader.finish(); }).size(), 1000u);
    EXPECT_LT(size_of(read_object("{\"" + name + "\":1,\"" + name + "\":1}").error()), 1000u);
    EXPECT_LT(size_of(read_object("{\"a\":\"" + name).error()), 1000u);
}

}  // namespace
}  // namespace lockstep::web
